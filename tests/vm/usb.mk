# SPDX-License-Identifier: MIT
# Boards on USB that fail: the cable, the board, the program that has it.

VM_TESTS += root:test_usb_faults:120
$(BUILD)/tests/vm/test_usb_faults: $(BUILD)/tests/vm/usb_cable.o
