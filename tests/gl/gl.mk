# SPDX-License-Identifier: MIT
# Programs on libglvnd, which loads the vendor library that was built; none needs a screen.
##@ Library and tools

GL_RUN = env LD_LIBRARY_PATH=$(abspath $(GL_FOLDER)) __GLX_VENDOR_LIBRARY_NAME=gloss \
	__EGL_VENDOR_LIBRARY_FILENAMES=$(abspath $(GL_FOLDER))/90_gloss.json GLOSS_DEVICE=model: \
	GLOSS_CONFIG=/dev/null vblank_mode=0

GL_SCENE_TESTS := $(addprefix test_gl_, draw polygon array array_random list light pixel get share)
GL_SCENE_TESTS += $(addprefix test_gl_, texture texture_state draw_pixels evaluator select perf)
GL_EGL_TESTS := test_egl test_egl_context test_gl_state test_gl_api $(GL_SCENE_TESTS)
GL_THREAD_TESTS := test_egl_context test_gl_draw test_gl_share
GL_TESTS := $(GL_EGL_TESTS) test_glx
GL_PROGRAMS := $(GL_TESTS:%=$(BUILD)/tests/gl/%)
$(GL_PROGRAMS): private LIBS := -lcmocka -lEGL -lGL -lX11 -lxcb -pthread
$(GL_PROGRAMS): $(BUILD)/tests/gl/gl_display.o
$(GL_SCENE_TESTS:%=$(BUILD)/tests/gl/%): $(BUILD)/tests/gl/gl_scene.o

# Its calls are generated, and it asks the table of commands which of them there are.
GL_CALLS_INC := $(BUILD)/generated/api_calls.inc
$(GL_CALLS_INC): tests/gl/api_calls mesa_shim/api/commands.h \
		$(filter-out mesa_shim/api/% mesa_shim/window/%,$(SHIM_SOURCES))
	@mkdir -p $(@D)
	$(Q)$^ >$@
FLAGS_tests/gl/test_gl_api.c = -Imesa_shim -I$(BUILD)/generated
$(BUILD)/tests/gl/test_gl_api.o: $(GL_CALLS_INC)
$(BUILD)/tests/gl/test_gl_api: $(SHIM_OBJECTS) $(BUILD)/libaccel.a
$(BUILD)/tests/gl/test_gl_api: private LIBS := -lcmocka -lEGL -lGL $(GL_LIBS) $(ACCEL_LIBS)

# Parts of the library alone.
GL_PART_TESTS := test_gl_names test_gl_batch test_gl_settings
FLAGS_tests/gl/test_gl_names.c = -Imesa_shim
FLAGS_tests/gl/test_gl_settings.c = -Imesa_shim -D_GNU_SOURCE
$(BUILD)/tests/gl/test_gl_names: $(BUILD)/mesa_shim/draw/names.o
$(BUILD)/tests/gl/test_gl_settings: $(BUILD)/mesa_shim/window/settings.o
$(BUILD)/tests/gl/test_gl_settings: private LIBS := -lcmocka -pthread
$(BUILD)/tests/gl/test_gl_names: private LIBS := -lcmocka
FLAGS_tests/gl/test_gl_batch.c = -Imesa_shim
$(BUILD)/tests/gl/test_gl_batch: $(SHIM_OBJECTS) $(BUILD)/libaccel.a
$(BUILD)/tests/gl/test_gl_batch: private LIBS := -lcmocka $(GL_LIBS) $(ACCEL_LIBS)
$(BUILD)/tests/gl/test_gl_batch: private WRAPS := $(call wrap,accel_draw_arrays)
run-test_gl_batch: export GLOSS_DEVICE := model:
$(foreach test,$(GL_PART_TESTS),$(eval $(call unit_run,$(BUILD)/tests/gl/$(test))))

$(GL_EGL_TESTS:%=run-%): run-%: $(BUILD)/tests/gl/% $(GL_FILES)
	$(call quiet,TEST,$*)
	$(Q)env -u DISPLAY $(GL_RUN) $<

# On a screen of 16 bits a pixel too, and where the server shares no memory.
run-test_glx: $(BUILD)/tests/gl/test_glx $(GL_FILES)
	$(call quiet,TEST,$(<F))
	$(Q)tests/gl/with_xvfb 24 $(GL_RUN) $<
	$(Q)tests/gl/with_xvfb 16 $(GL_RUN) $<
	$(Q)tests/gl/with_xvfb 24+noshm $(GL_RUN) $<

ifneq ($(GL_FOUND),)
UNIT_TESTS += $(GL_TESTS) $(GL_PART_TESTS)
SANITIZED_TESTS += $(GL_EGL_TESTS) $(GL_PART_TESTS)
THREAD_TESTS += $(GL_THREAD_TESTS)
endif

# Any calls and arrays, many more than the unit tests have.
.PHONY: gl-fuzz
gl-fuzz: export GL_CALLS ?= 10000000
gl-fuzz: export GL_ARRAYS ?= 100000
gl-fuzz: ## millions of random calls of OpenGL under ASan and UBSan (GL_CALLS, GL_ARRAYS)
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/asan CFLAGS='$(SANITIZED_CFLAGS)' \
		run-test_gl_api run-test_gl_array_random

# The device stays to the end, and with it threads, whose stacks look lost to valgrind.
.PHONY: gl-valgrind
gl-valgrind: $(GL_EGL_TESTS:%=$(BUILD)/tests/gl/%) $(GL_FILES) ## programs of EGL under valgrind
	$(Q)for test in $(GL_EGL_TESTS); do \
		env -u DISPLAY $(GL_RUN) valgrind -q --error-exitcode=1 --leak-check=full \
			--show-leak-kinds=definite --errors-for-leak-kinds=definite \
			$(BUILD)/tests/gl/$$test >/dev/null || exit 1; \
	done

ifneq ($(GL_FOUND),)
CHECKS += gl-valgrind
endif
