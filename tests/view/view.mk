# SPDX-License-Identifier: MIT
# The demo, gloss-view as a stranger meets it, and tests of its parts.
##@ Library and tools

.PHONY: demo-run view view-window
demo-run: $(BUILD)/gloss-view $(SIM_DIR)/accel-sim-t64-k8.so
	$(Q)GLOSS_SIM_PATH=$(SIM_DIR) tests/view/demo $(BUILD)/gloss-view $(MODELS)/bunny.obj $(BUILD)/demo

view: $(BUILD)/gloss-view ## gloss-view's messages, exit codes and files
	$(Q)tests/view/run $(abspath $<)
	$(Q)tests/view/meshes $(abspath $<) $(MODELS)
	$(Q)tests/view/completion $(abspath $<)

view-window: $(BUILD)/gloss-view ## gloss-view's window on an X server without a screen
	$(Q)tests/view/window $(abspath $<)

# A test of the viewer's insides includes the file it is about.
VIEW_TESTS := test_mesh test_mesh_build test_mesh_child test_mesh_plain test_mesh_shape test_phong \
	test_phong_cover test_picture test_view_camera test_view_draw \
	test_view_progress test_view_window

FLAGS_tests/view := $(SCENE_CFLAGS)
VIEW_TEST_PROGRAMS := $(VIEW_TESTS:%=$(BUILD)/tests/view/%)
$(VIEW_TEST_PROGRAMS): private LIBS := -lcmocka $(VIEW_LIBS)
$(VIEW_TEST_PROGRAMS): $(SCENE_OBJS) $(BUILD)/libaccel.a
# With the rest of the viewer.
$(foreach part,draw progress window,$(eval \
	$(BUILD)/tests/view/test_view_$(part): $(filter-out %/$(part).o,$(VIEW_OBJS))))

$(VIEW_TESTS:%=run-%): run-%: $(BUILD)/tests/view/%
	$(call quiet,TEST,$*)
	$(Q)$<

# The same with the compiler's checks built in. SDL's own libraries leak.
.PHONY: view-sanitize
view-sanitize: ## gloss-view and its tests under ASan and UBSan
	$(Q)+ASAN_OPTIONS=detect_leaks=0 $(SANITIZED_MAKE) BUILD=$(BUILD)/asan-view \
		CFLAGS='$(SANITIZED_CFLAGS)' run-test_view_window
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/asan-view CFLAGS='$(SANITIZED_CFLAGS)' \
		SANITIZED=yes $(patsubst %,run-%,$(filter-out %_window,$(VIEW_TESTS))) view

UNIT_TESTS += $(VIEW_TESTS)
CHECKS += view view-window view-sanitize
