# SPDX-License-Identifier: MIT
# The demo, and gloss-view as a stranger meets it.

.PHONY: demo-run
demo-run: $(BUILD)/gloss-view $(SIM_DIR)/accel-sim-t64-k8.so
	$(Q)GLOSS_SIM_PATH=$(SIM_DIR) tests/view/demo $(BUILD)/gloss-view $(MODELS)/bunny.obj $(BUILD)/demo
