# SPDX-License-Identifier: MIT
# Programs on libglvnd, which loads the vendor library that was built; none needs a screen.
##@ Library and tools

GL_RUN = env LD_LIBRARY_PATH=$(abspath $(GL_FOLDER)) __GLX_VENDOR_LIBRARY_NAME=gloss \
	__EGL_VENDOR_LIBRARY_FILENAMES=$(abspath $(GL_FOLDER))/90_gloss.json GLOSS_DEVICE=model: vblank_mode=0

GL_EGL_TESTS := test_egl test_egl_context
GL_TESTS := $(GL_EGL_TESTS)
GL_PROGRAMS := $(GL_TESTS:%=$(BUILD)/tests/gl/%)
$(GL_PROGRAMS): private LIBS := -lcmocka -lEGL -lGL -lX11 -lxcb -pthread
$(GL_PROGRAMS): $(BUILD)/tests/gl/gl_display.o

$(GL_EGL_TESTS:%=run-%): run-%: $(BUILD)/tests/gl/% $(GL_FILES)
	$(call quiet,TEST,$*)
	$(Q)env -u DISPLAY $(GL_RUN) $<

ifneq ($(GL_FOUND),)
UNIT_TESTS += $(GL_TESTS)
endif

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
