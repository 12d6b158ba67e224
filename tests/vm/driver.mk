# SPDX-License-Identifier: MIT
# Tests of the kernel module alone: what its files say to right, wrong and hostile programs, and
# what it does when the board fails.

VM_TESTS += user:test_ioctl user:test_submit user:test_submit_limits \
	user:test_isolation:600 user:test_reuse:600 root:test_storm:600 \
	root:test_inspect root:test_fault:600 root:test_exit:600 root:test_power:600 root:test_unplug:600 \
	root:test_failslab:600 user:test_fuzz_ioctl user:test_memory:600 root:test_swap root:test_fences \
	root:test_coredump user:test_clocks root:test_fair:600 root:test_clear
VM_BENCHES += root:test_latency
VM_FIGURES += test_fair

DRIVER_TESTS := $(addprefix $(BUILD)/tests/vm/test_, ioctl submit submit_limits isolation reuse storm \
	latency inspect fault exit power unplug failslab fuzz_ioctl memory swap fences coredump clocks \
	fair clear)
$(DRIVER_TESTS): $(BUILD)/tests/vm/gloss_node.o

$(addprefix $(BUILD)/tests/vm/test_, latency inspect fault exit power unplug swap): \
	$(BUILD)/tests/vm/vm_board.o
$(addprefix $(BUILD)/tests/vm/test_, exit power unplug): $(BUILD)/tests/vm/vm_pair.o
$(addprefix $(BUILD)/tests/vm/test_, submit submit_limits): $(BUILD)/tests/vm/vm_submit.o

$(BUILD)/tests/vm/test_isolation: $(STREAM_RANDOM_OBJS)

# Where the C library has dlopen() apart.
$(BUILD)/tests/vm/test_inspect: private LIBS = -lcmocka $(ACCEL_LIBS) -ldl

VM_NEEDS += $(BUILD)/gloss-decode

# What tests need of their own in the kernel, built beside gloss.ko for the kernel it is for.
VM_MODULES := $(MODULE_BUILD)/test/.built
VM_MODULE_SOURCES := $(sort $(wildcard tests/vm/modules/*.c)) tests/vm/modules/Kbuild

.PHONY: vm-test-modules
vm-test-modules: $(VM_MODULES)
	@:

$(VM_MODULES): $(VM_MODULE_SOURCES) $(MODULE_BUILD)/kdir
	$(call quiet,KBUILD,tests/vm/modules)
	@mkdir -p $(@D)
	$(Q)ln -sf $(abspath $(VM_MODULE_SOURCES)) $(@D)/
	$(Q)$(MAKE) --no-print-directory $(if $(filter 0,$(V)),-s) -C $(KDIR) \
		M=$(abspath $(@D)) W=1 KCFLAGS=-Werror CONFIG_DEBUG_INFO_BTF_MODULES= modules
	@touch $@
