# SPDX-License-Identifier: MIT
# Tests in a virtual machine: a Debian kernel, the module, and two virtual boards. See README.md.

# A test program: tests/vm/NAME.c (or .sh) makes $(BUILD)/tests/vm/NAME. The list it runs from has
# WHO:NAME[:SECONDS], WHO root or user; fragments of single tests add theirs.
VM_TESTS :=

-include $(sort $(filter-out tests/vm/vm.mk,$(wildcard tests/vm/*.mk)))

VM_CFLAGS = -Idriver -Ilibaccel -Itools/vboard $(shell pkg-config --cflags libdrm)
VM_LIBS   = $(shell pkg-config --libs libdrm) -lcmocka -lpthread -ldl -lm

# What a program needs besides, objects or archives, is a prerequisite of its own:
# $(BUILD)/tests/vm/NAME: $(BUILD)/tests/vm/HELPER.o
$(BUILD)/tests/vm/%: tests/vm/%.c $(BUILD)/libaccel/parts.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(VM_CFLAGS) $(CFLAGS) -MMD -MP -MF $@.d $(filter %.c %.o,$^) \
		$(filter %.a,$^) $(VM_LIBS) -o $@

$(BUILD)/tests/vm/%.o: tests/vm/%.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(VM_CFLAGS) $(CFLAGS) -MMD -MP -MF $@.d -c $< -o $@

$(BUILD)/tests/vm/%: tests/vm/%.sh
	@mkdir -p $(@D)
	$(Q)install -m 755 $< $@

-include $(wildcard $(BUILD)/tests/vm/*.d)
