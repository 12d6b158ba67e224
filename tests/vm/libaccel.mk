# SPDX-License-Identifier: MIT
# The library and gloss-view on the driver's nodes.

VM_TESTS += user:test_bunny user:test_stream_drm user:test_triangle root:test_view_device \
	root:test_library
VM_NEEDS += $(BUILD)/gloss-view $(BUILD)/tests/vm/triangle

# Random jobs on any board.
VM_STREAM_OBJS := $(BUILD)/tests/vm/vm_stream.o $(STREAM_RANDOM_OBJS)
$(BUILD)/tests/vm/test_stream_drm: $(VM_STREAM_OBJS)
$(BUILD)/tests/vm/test_library: $(BUILD)/tests/vm/vm_board.o

# The first program of README.md.
$(BUILD)/tests/vm/triangle: private LIBS := $(ACCEL_LIBS)
$(BUILD)/tests/vm/triangle: $(BUILD)/examples/triangle.o $(BUILD)/libaccel.a
	$(link)
