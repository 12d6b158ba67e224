# SPDX-License-Identifier: MIT
# Meshes, scenes and pictures: what gloss-view, the programs that measure pictures and the tests share.

# Files that appear whole or not at all: pictures, and what hwgen writes.
OUTPUT_OBJECT := $(BUILD)/tools/scene/output.o
# Boards that open, or a line that says why not.
DEVICE_OBJECT := $(BUILD)/tools/scene/device.o
SCENE_OBJS := $(patsubst %.c,$(BUILD)/%.o,$(sort $(wildcard tools/scene/*.c)))

SCENE_CFLAGS := $(shell pkg-config --cflags assimp libpng sdl2 2>/dev/null) -D_GNU_SOURCE
SCENE_LIBS := -lassimp -lpng $(ACCEL_LIBS)

FLAGS_tools/scene := $(SCENE_CFLAGS)
# Vectors of roots and comparisons: nothing looks at errno or at the processor's exception flags.
FLAGS_tools/scene/mesh_face.c := -fno-math-errno -fno-trapping-math
