# SPDX-License-Identifier: MIT
# The demo, gloss-view as a stranger meets it, and tests of its parts.

.PHONY: demo-run view
demo-run: $(BUILD)/gloss-view $(SIM_DIR)/accel-sim-t64-k8.so
	$(Q)GLOSS_SIM_PATH=$(SIM_DIR) tests/view/demo $(BUILD)/gloss-view $(MODELS)/bunny.obj $(BUILD)/demo

view: $(BUILD)/gloss-view ## gloss-view's messages, exit codes and files
	$(Q)tests/view/run $(abspath $<)
	$(Q)tests/view/meshes $(abspath $<) $(MODELS)
	$(Q)tests/view/completion $(abspath $<)

# A test of the viewer's insides includes the file it is about.
VIEW_TESTS := test_mesh test_mesh_build test_mesh_child test_mesh_plain test_mesh_shape test_phong \
	test_phong_cover test_picture test_view_camera test_view_draw \
	test_view_progress test_view_window

$(VIEW_TESTS:%=$(BUILD)/tests/view/%): $(BUILD)/tests/view/%: tests/view/%.c $(SCENE_OBJS) \
		$(BUILD)/libaccel.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(VIEW_CFLAGS) $(CFLAGS) -MMD -MP -MF $@.d $< $(view_objs) \
		$(SCENE_OBJS) $(BUILD)/libaccel.a -lcmocka $(SCENE_LIBS) $$(pkg-config --libs sdl2) -o $@

# With the rest of the viewer.
define viewer_test
$(BUILD)/tests/view/test_view_$(1): $$(VIEW_OBJS)
$(BUILD)/tests/view/test_view_$(1): view_objs = $$(filter-out %/$(1).o,$$(VIEW_OBJS))
endef
$(foreach part,draw progress window,$(eval $(call viewer_test,$(part))))

$(VIEW_TESTS:%=run-%): run-%: $(BUILD)/tests/view/%
	$(call quiet,TEST,$*)
	$(Q)$<

-include $(VIEW_TESTS:%=$(BUILD)/tests/view/%.d)

# The same with the compiler's checks built in. SDL's own libraries leak.
.PHONY: view-sanitize
view-sanitize: ## gloss-view and its tests under ASan and UBSan
	$(Q)+ASAN_OPTIONS=detect_leaks=0 $(SANITIZED_MAKE) BUILD=$(BUILD)/asan-view \
		CFLAGS='$(SANITIZED_CFLAGS)' run-test_view_window
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/asan-view CFLAGS='$(SANITIZED_CFLAGS)' \
		SANITIZED=yes $(patsubst %,run-%,$(filter-out %_window,$(VIEW_TESTS))) view

UNIT_TESTS += $(VIEW_TESTS)
CHECKS += view view-sanitize
