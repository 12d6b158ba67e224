# SPDX-License-Identifier: MIT
# Boards on USB that fail: the cable, the board, the program that has it.

VM_TESTS += root:test_usb_faults:900
VM_ONCE += test_usb_faults

# Under ASan, the library too: so that nothing that fails leaves anything behind.
ifeq ($(VM_SANITIZED),yes)
$(BUILD)/tests/vm/test_usb_faults: $(BUILD)/tests/vm/usb_cable.o
else
VM_SANITIZED_BUILD := $(BUILD)/asan-vm
$(BUILD)/tests/vm/test_usb_faults: FORCE
	$(Q)+$(SANITIZED_MAKE) BUILD=$(VM_SANITIZED_BUILD) VM_SANITIZED=yes \
		CFLAGS='$(SANITIZED_CFLAGS)' $(VM_SANITIZED_BUILD)/tests/vm/test_usb_faults
	@mkdir -p $(@D)
	$(Q)cmp -s $(VM_SANITIZED_BUILD)/tests/vm/test_usb_faults $@ || \
		cp $(VM_SANITIZED_BUILD)/tests/vm/test_usb_faults $@
endif
