# SPDX-License-Identifier: MIT
# Meshes, scenes and pictures: what gloss-view, the programs that measure pictures and the tests share.

SCENE_SOURCES := $(addprefix tools/scene/, matrix.c mesh.c mesh_build.c mesh_child.c mesh_face.c \
	mesh_file.c mesh_import.c mesh_part.c mesh_place.c mesh_shape.c mesh_weld.c \
	phong.c phong_fill.c picture.c picture_text.c quality.c scene.c)
# Files that appear whole or not at all: pictures, and what hwgen writes.
OUTPUT_OBJECT := $(BUILD)/tools/scene/output.o
# Boards that open, or a line that says why not.
DEVICE_OBJECT := $(BUILD)/tools/scene/device.o

SCENE_PARTS := $(SCENE_SOURCES:%.c=$(BUILD)/%.o)
SCENE_OBJS := $(SCENE_PARTS) $(OUTPUT_OBJECT) $(DEVICE_OBJECT)

VIEW_PACKAGES := assimp libpng sdl2
VIEW_CFLAGS := $$(pkg-config --cflags $(VIEW_PACKAGES)) -D_GNU_SOURCE -Itools
SCENE_LIBS = -lassimp -lpng $(ACCEL_LIBS)

$(SCENE_PARTS): ACCEL_CFLAGS += $(VIEW_CFLAGS)
$(OUTPUT_OBJECT) $(DEVICE_OBJECT): ACCEL_CFLAGS += -Itools
$(SCENE_OBJS): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -MMD -MP -c $< -o $@

# Vectors of roots and comparisons: nothing looks at errno or at the processor's exception flags.
$(BUILD)/tools/scene/mesh_face.o: ACCEL_CFLAGS += -fno-math-errno -fno-trapping-math

-include $(SCENE_OBJS:.o=.d)
