# SPDX-License-Identifier: MIT
# The draw level: frames of anything, on the model, under the compiler's checks.
##@ Fuzzing

FUZZ_DRAW_FRAMES ?= 100000
FUZZ_DRAW_SHORT  ?= 10000
# Without boards, which take other libraries.
FUZZ_DRAW_SOURCES := $(addprefix tests/fuzz/fuzz_draw,.c _numbers.c _state.c) $(MODEL_SOURCES) \
	$(filter-out $(DRM_SOURCES) $(USB_SOURCES),$(ACCEL_SOURCES)) \
	libaccel/transport/drm/none.c libaccel/transport/usb/none.c

$(BUILD)/fuzz/fuzz_draw: private LIBS := -lm -ldl -pthread
$(BUILD)/fuzz/fuzz_draw: private WRAPS := $(call wrap,malloc calloc realloc)
$(BUILD)/fuzz/fuzz_draw: $(FUZZ_DRAW_SOURCES:%.c=$(BUILD)/fuzz/draw/%.o)
	$(call fuzz_link,draw)

.PHONY: fuzz-draw fuzz-draw-short
fuzz-draw: $(BUILD)/fuzz/fuzz_draw ## meshes and states of anything, FUZZ_DRAW_FRAMES=100000
	$(Q)$< $(FUZZ_DRAW_FRAMES)

fuzz-draw-short: $(BUILD)/fuzz/fuzz_draw
	$(Q)$< $(FUZZ_DRAW_SHORT)

CHECKS += fuzz-draw-short
