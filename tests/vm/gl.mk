# SPDX-License-Identifier: MIT
# Programs of OpenGL on the boards.
ifneq ($(GL_FOUND),)
VM_TESTS += user:test_gl:600
VM_ONCE += test_gl
VM_NEEDS += $(GL_FILES) $(BUILD)/tests/gl/frames.so
endif
