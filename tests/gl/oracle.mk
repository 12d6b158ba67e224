# SPDX-License-Identifier: MIT
# The library's vertices and triangles against OpenGL's, as the specification has them. More scenes:
# GL_SCENES=100000 make run-test_draws_gl
ORACLE_OBJECTS := $(addprefix $(BUILD)/tests/gl/,oracle.o oracle_light.o oracle_assemble.o oracle_clip.o \
	oracle_raster.o oracle_strokes.o)
ORACLE_TESTS := test_oracle test_draws_gl test_draws_gl_random test_strokes_gl test_shades_gl
ORACLE_PROGRAMS := $(ORACLE_TESTS:%=$(BUILD)/tests/gl/%)

$(ORACLE_PROGRAMS): $(ORACLE_OBJECTS)
$(filter-out %/test_oracle,$(ORACLE_PROGRAMS)): $(BUILD)/tests/gl/scene.o $(BUILD)/tests/gl/scene_random.o \
	$(BUILD)/libaccel/parts.a
$(foreach program,$(ORACLE_PROGRAMS),$(eval $(call unit_run,$(program))))
UNIT_TESTS += $(ORACLE_TESTS)
