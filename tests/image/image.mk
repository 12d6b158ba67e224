# SPDX-License-Identifier: MIT
# Pictures: how good they are, and that they do not change.
##@ Pictures and figures

MODELS ?= /usr/share/glmark2/models

IMAGE_PROGRAMS := $(BUILD)/tests/image/nmse $(BUILD)/tests/image/golden

FLAGS_tests/image := $(SCENE_CFLAGS)
$(IMAGE_PROGRAMS): private LIBS := $(SCENE_LIBS)
$(IMAGE_PROGRAMS): $(SCENE_OBJS) $(BUILD)/libaccel.a

NMSE_MESHES := sphere:1 sphere:2 sphere:3 torus:24 torus:48 $(MODELS)/bunny.obj

# Every core draws the same bytes.
GOLDEN_SIMS := t64-k8 t32-k1
GOLDEN_DEVICES := model: model:tile=32 sim: sim:tile=32,lanes=1

.PHONY: nmse nmse-table golden
nmse: $(BUILD)/tests/image/nmse ## quality against per-pixel Phong, as a table
	@mkdir -p $(BUILD)/bench
	$(Q)$< --figure $(BUILD)/bench/nmse.txt model: $(NMSE_MESHES)

nmse-table: $(BUILD)/tests/image/nmse
	$(Q)$< --markdown model: $(NMSE_MESHES) >$(BUILD)/nmse.md
	$(Q)sed -i -e '/^<!-- nmse -->$$/,/^<!-- end -->$$/{//!d}' -e '/^<!-- nmse -->$$/r $(BUILD)/nmse.md' \
		docs/figures.md

golden: $(BUILD)/tests/image/golden $(GOLDEN_SIMS:%=$(SIM_DIR)/accel-sim-%.so) ## pictures that must not change; tests/image/refresh makes them anew
	$(Q)for device in $(GOLDEN_DEVICES); do \
		GLOSS_SIM_PATH=$(SIM_DIR) $< $$device tests/image/golden $(<D) || exit 1; \
	done

CHECKS += nmse golden
