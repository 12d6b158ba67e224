# SPDX-License-Identifier: MIT
# Tests in a virtual machine: a Debian kernel, the module, and four virtual boards. See README.md.
# KERNEL: which kernels, such as 6.12; all of tests/vm/kernels if not given.
##@ In a virtual machine

# A test program: tests/vm/NAME.c (or .sh) makes $(BUILD)/tests/vm/NAME. The list it runs from has
# WHO:NAME[:SECONDS], WHO root or user; fragments of single tests add theirs.
VM_TESTS := user:test_smoke
# Figures for make bench, in the same form: no tests, as on a busy machine they miss their aims.
VM_BENCHES :=
# Names of tests that count something for make bench, too.
VM_FIGURES :=
# Those that check-vm runs on the newest kernel alone: long, and gloss.ko has no part in them.
VM_ONCE :=
# What else has to be built before they run.
VM_NEEDS :=

-include $(sort $(filter-out tests/vm/vm.mk,$(wildcard tests/vm/*.mk)))

FLAGS_tests/vm := $(DRM_CFLAGS) $(USB_CFLAGS)

$(BUILD)/tests/vm/%: tests/vm/%.sh
	@mkdir -p $(@D)
	$(Q)install -m 755 $< $@

# What a program needs besides, objects or archives, is a prerequisite of its own:
# $(BUILD)/tests/vm/NAME: $(BUILD)/tests/vm/HELPER.o
vm_names    = $(foreach test,$(1),$(word 2,$(subst :, ,$(test))))
VM_NAMES    = $(call vm_names,$(VM_TESTS) $(VM_BENCHES))
VM_NO_BENCH = $(patsubst %,--without %,$(call vm_names,$(VM_BENCHES)))
VM_PROGRAMS = $(VM_NAMES:%=$(BUILD)/tests/vm/%)

$(patsubst %.c,$(BUILD)/%,$(wildcard tests/vm/test_*.c)): $(BUILD)/libaccel/parts.a

VM_RUNNER_SOURCES := $(wildcard tests/vm/runner/*.c)
$(BUILD)/tests/vm/runner: $(VM_RUNNER_SOURCES) tests/vm/runner/runner.h
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) $(VM_RUNNER_SOURCES) -o $@

# For QEMU, see there.
$(BUILD)/tests/vm/no_kvm.so: tests/vm/no_kvm.c
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(CC) -std=gnu11 $(WARN) $(CFLAGS) -fPIC -shared $< -ldl -o $@
VM_NEEDS += $(BUILD)/tests/vm/no_kvm.so

$(BUILD)/tests/vm/list: FORCE
	@mkdir -p $(@D)
	@printf '%s\n' $(VM_TESTS) $(VM_BENCHES) | cmp -s - $@ || \
		printf '%s\n' $(VM_TESTS) $(VM_BENCHES) >$@

.PHONY: vm-programs vm-modules check-vm check-kasan bench-vm
vm-programs: $(VM_PROGRAMS) $(VM_NEEDS) $(BUILD)/tests/vm/runner $(BUILD)/tests/vm/list \
	$(BUILD)/vboard-pci $(BUILD)/vboard-usb $(BOARD_RTL_PLUGIN) $(USB_RTL_PLUGIN) ## what runs in the virtual machine, and its boards

# Each kernel has a module of its own in driver-KERNEL, and its results in vm-KERNEL.
vm-modules-%:
	$(Q)release=$$(tests/vm/kernels --release $*) && \
	$(MAKE) --no-print-directory module vm-test-modules KDIR=/lib/modules/$$release/build \
		MODULE_BUILD=$(BUILD)/driver-$*

check-vm-%: vm-modules-%
	$(Q)tests/vm/run --build $(BUILD) --kernel $* $(VM_NO_BENCH) $(if $(filter $*,$(VM_NEWEST)),,$(VM_ONCE:%=--without %))

# At run time, as what is missing is told here and not to those who build something else.
FOR_KERNELS = kernels=$$(tests/vm/kernels $(KERNEL)) && set -- $$kernels && \
	$(MAKE) --no-print-directory VM_NEWEST=$$1

vm-modules: ## gloss.ko for the virtual machine (KERNEL)
	$(Q)+$(FOR_KERNELS) $$(printf 'vm-modules-%s ' "$$@")

check-vm: vm-programs ## the driver on virtual boards, in a virtual machine (KERNEL: 6.1 or 6.12; both)
	$(Q)+$(FOR_KERNELS) -k $$(printf 'check-vm-%s ' "$$@")

bench-vm: vm-programs ## time of an empty job through the driver, streams and answers over USB
	$(Q)+$(FOR_KERNELS) vm-modules-$$1 && \
	tests/bench/retry - tests/vm/run --build $(BUILD) --kernel $$1 --results $(BUILD)/vm \
		$(call vm_names,$(VM_BENCHES)) $(VM_FIGURES)

run-kernels:
	$(call quiet,TEST,kernels)
	$(Q)tests/vm/test_kernels.sh $(BUILD)/tests/vm/kernels

run-vm-run:
	$(call quiet,TEST,vm/run)
	$(Q)tests/vm/test_run.sh $(BUILD)/tests/vm/test_run

UNIT_TESTS += kernels vm-run
CHECKS  += check-vm
BENCHES += bench-vm

# The same on kernels that check everything, of each source that Debian installs; with modules made
# for those.
KASAN_KERNELS = $(or $(KERNEL),$(patsubst /usr/src/linux-source-%.tar.xz,%,$(wildcard \
	/usr/src/linux-source-*.tar.xz)),6.12)

check-kasan-%:
	$(Q)kernel=$$(tests/vm/kasan-kernel $* $(or $(GLOSS_CACHE),$(BUILD))) && \
	$(MAKE) --no-print-directory module vm-test-modules KDIR=$$kernel/build \
		MODULE_BUILD=$(BUILD)/driver-kasan-$* && \
	tests/vm/run --build $(BUILD) --driver $(BUILD)/driver-kasan-$* \
		--results $(BUILD)/vm-kasan-$* --kernel $$kernel/bzImage --modules none --debug --slow 5 \
		$(VM_NO_BENCH)

check-kasan: vm-programs ## check-vm with KASAN, lockdep, kmemleak... (KERNEL); builds kernels at first
	$(Q)+$(MAKE) --no-print-directory -k $(KASAN_KERNELS:%=check-kasan-%)
