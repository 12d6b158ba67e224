# SPDX-License-Identifier: MIT
# The draw level: frames of anything, on the model, under the compiler's checks.

FUZZ_DRAW_FRAMES ?= 100000
FUZZ_DRAW_SHORT  ?= 10000
FUZZ_DRAW_CFLAGS := -g -O1 -fno-omit-frame-pointer -fno-sanitize-recover=all \
	-fsanitize=address,undefined,float-cast-overflow -DACCEL_SIM_DIR='""' -pthread
# Without boards, which take other libraries.
FUZZ_DRAW_SOURCES := tests/fuzz/fuzz_draw.c $(MODEL_SOURCES) \
	$(filter-out $(addprefix libaccel/,$(DRM_SOURCES) $(USB_SOURCES)),$(ACCEL_SOURCES)) \
	libaccel/transport/drm/none.c libaccel/transport/usb/none.c
FUZZ_DRAW_OBJS := $(FUZZ_DRAW_SOURCES:%.c=$(BUILD)/fuzz/draw/%.o)

$(FUZZ_DRAW_OBJS): $(BUILD)/fuzz/draw/%.o: %.c
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(ACCEL_CFLAGS) $(FUZZ_DRAW_CFLAGS) -MMD -MP -c $< -o $@

$(BUILD)/fuzz/fuzz_draw: $(FUZZ_DRAW_OBJS)
	$(call quiet,LD,$@)
	$(Q)$(FUZZ_CC) $(FUZZ_DRAW_CFLAGS) -Wl,--wrap=malloc -Wl,--wrap=calloc -Wl,--wrap=realloc \
		$^ -lm -ldl -o $@

-include $(FUZZ_DRAW_OBJS:.o=.d)

.PHONY: fuzz-draw fuzz-draw-short
fuzz-draw: $(BUILD)/fuzz/fuzz_draw ## meshes and states of anything, FUZZ_DRAW_FRAMES=100000
	$(Q)$< $(FUZZ_DRAW_FRAMES)

fuzz-draw-short: $(BUILD)/fuzz/fuzz_draw
	$(Q)$< $(FUZZ_DRAW_SHORT)

CHECKS += fuzz-draw-short
