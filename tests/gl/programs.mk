# SPDX-License-Identifier: MIT
# Programs that know nothing of Gloss, as they are installed, on the OpenGL vendor library.
##@ Library and tools

# mesa-utils' programs, as they are, say what is true.
.PHONY: gl-programs
gl-programs: $(GL_FILES) ## glxinfo and eglinfo on the OpenGL vendor library
	$(call quiet,TEST,gl-programs)
	$(Q)tests/gl/with_xvfb 24 $(GL_RUN) tests/gl/programs $(BUILD)/tests/gl

# Programs whose pictures are compared. What is preloaded says at its top for what.
GL_PRELOADS := $(addprefix $(BUILD)/tests/gl/,still_clock.so pixel_light.so frames.so)
$(GL_PRELOADS): $(BUILD)/tests/gl/%.so: tests/gl/%.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -D_GNU_SOURCE -fPIC -shared $< -lX11 -o $@
$(BUILD)/tests/gl/gl_shot: private LIBS := -lX11
GL_DRAWING := $(GL_FILES) $(BUILD)/tests/gl/gl_shot $(GL_PRELOADS)
GL_DRAWERS := gl-gears gl-demo gl-picture gl-hacks gl-hacks-some gl-devices bench-gl
$(GL_DRAWERS): export VENDOR := $(abspath $(GL_FOLDER))
$(GL_DRAWERS): export TOOLS := $(abspath $(BUILD)/tests/gl)

.PHONY: $(GL_DRAWERS)
gl-gears: $(GL_DRAWING) ## glxgears as softpipe draws it
	$(call quiet,TEST,gl-gears)
	$(Q)tests/gl/with_xvfb 24 tests/gl/gears $(BUILD)/tests/gl/gears

$(BUILD)/examples/teapot: private LIBS := -lglut -lGL
$(BUILD)/examples/teapot: $(BUILD)/examples/teapot.o
	$(link)
gl-demo gl-picture: export TEAPOT := $(abspath $(BUILD)/examples/teapot)
gl-demo: $(GL_DRAWING) $(BUILD)/examples/teapot ## glxgears and a teapot, Gouraud and adaptive: build/gl-demo/sheet.png
	$(call quiet,TEST,gl-demo)
	$(Q)tests/gl/with_xvfb 24 tests/gl/demo --check docs/pictures/opengl.png $(BUILD)/gl-demo

gl-picture: $(GL_DRAWING) $(BUILD)/examples/teapot
	$(Q)tests/gl/with_xvfb 24 tests/gl/demo --write docs/pictures/opengl.png $(BUILD)/gl-demo

# Screen savers without textures, and mesa-utils' programs. The table says how near they are.
GL_HACKS = tests/gl/with_xvfb 24 tests/gl/hacks
GL_HACKS_SOME := glxgears glxheads jigglypuff morph3d pipes sierpinski3d
gl-hacks: $(GL_DRAWING) ## 300 frames of some thirty programs, as softpipe draws them
	$(Q)$(GL_HACKS) tests/gl/hacks.txt $(BUILD)/gl-hacks

gl-hacks-some: $(GL_DRAWING) ## 30 frames of some of them
	$(call quiet,TEST,$@)
	$(Q)$(GL_HACKS) --frames 30 tests/gl/hacks.txt $(BUILD)/gl-hacks $(GL_HACKS_SOME)

# The RTL; boards on PCI and USB are tests/vm/test_gl.sh's.
gl-devices: $(GL_DRAWING) $(SIM_DIR)/accel-sim-t64-k8.so ## a screen saver draws the same on the Verilated core
	$(call quiet,TEST,$@)
	$(Q)GLOSS_SIM_PATH=$(SIM_DIR) tests/gl/with_xvfb 24+noglx tests/gl/on_devices $(BUILD)/gl-devices pipes sim: \
		>$(BUILD)/gl-devices.log || { status=$$?; cat $(BUILD)/gl-devices.log; [ $$status -eq 77 ]; }

bench-gl: $(GL_DRAWING) ## glxgears, frames a processor second against Mesa's drivers (SHORT=1: one round)
	$(Q)$(call keep_figures,gl,tests/gl/with_xvfb 24 tests/gl/bench $(SHORT_OPTION))

# The results that there were are in piglit.txt.
PIGLIT = tests/gl/with_xvfb 24 $(GL_RUN) tests/gl/piglit
PIGLIT_SOME := array-stride clipflat degenerate-prims draw-elements gl-1.0-dlist-materials gl-1.0-push-no-attribs \
	gl-1.0-readpixels-oob gl-1.0-scissor-many gl-1.2-rescale-normal linestipple quad-invariance \
	triangle-rasterization-overdraw two-sided-lighting user-clip
.PHONY: check-piglit accept-piglit piglit-some
check-piglit: $(GL_FILES) ## Debian's piglit, 222 tests for OpenGL 1.5: none is worse than it was
	$(Q)$(PIGLIT) --figure $(BUILD)/bench/piglit.txt tests/gl/piglit.txt $(BUILD)/piglit

accept-piglit: $(GL_FILES)
	$(Q)$(PIGLIT) --accept tests/gl/piglit.txt $(BUILD)/piglit

piglit-some: $(GL_FILES) ## one of each kind of its tests, if it is installed
	$(call quiet,TEST,$@)
	$(Q)$(PIGLIT) tests/gl/piglit.txt $(BUILD)/piglit $(PIGLIT_SOME)

ifneq ($(GL_FOUND),)
CHECKS += gl-programs gl-gears gl-demo gl-hacks-some gl-devices piglit-some
BENCHES += bench-gl check-piglit
pictures: gl-picture
endif
