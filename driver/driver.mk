# SPDX-License-Identifier: MIT
# The kernel module gloss.ko, built outside its sources, and what is checked of it
# without running it. KDIR is the kernel to build for and MODULE_BUILD the place; both
# can be given, as tests/vm does for its own kernel.

ifndef KDIR
KDIR := $(firstword $(wildcard /lib/modules/$(shell uname -r)/build) \
	$(lastword $(shell ls -d /lib/modules/*/build 2>/dev/null | sort -V)))
endif
MODULE_BUILD ?= $(BUILD)/driver
MODULE := $(MODULE_BUILD)/gloss.ko
MODULE_SOURCES := $(sort $(wildcard driver/*.[ch])) driver/Kbuild driver/features.sh \
	driver/features.table

# BTF of a module needs the kernel's own vmlinux, which the headers do not bring. Locked, as
# two makes at once would take each other's files away.
KBUILD = flock $(MODULE_BUILD)/kdir $(MAKE) --no-print-directory $(if $(filter 0,$(V)),-s) -C $(KDIR) \
	M=$(abspath $(MODULE_BUILD)) W=1 KCFLAGS=-Werror CONFIG_DEBUG_INFO_BTF_MODULES=

.PHONY: module install-module FORCE
module: $(MODULE) ## build gloss.ko (KDIR: for which kernel, MODULE_BUILD: where)

$(MODULE): $(MODULE_SOURCES) $(MODULE_BUILD)/kdir
	$(call quiet,KBUILD,$@)
	$(Q)ln -sf $(abspath $(MODULE_SOURCES)) $(MODULE_BUILD)/
	$(Q)+$(KBUILD) modules
	@touch $@

$(MODULE_BUILD)/kdir: FORCE
	@[ -e "$(KDIR)/Makefile" ] || { \
		echo "gloss.ko: no headers of a kernel here; run 'make deps', or give KDIR" >&2; \
		exit 1; }
	@mkdir -p $(@D)
	@echo $(KDIR) | cmp -s - $@ || echo $(KDIR) >$@

# Not Kbuild's modules_install, which misses a signing key and System.map of Debian's headers.
KRELEASE = $(shell cut -s -d\" -f2 $(KDIR)/include/generated/utsrelease.h)

install-module: $(MODULE) ## install gloss.ko for the kernel of KDIR (DESTDIR)
	$(Q)install -D -m 644 $< $(DESTDIR)/lib/modules/$(KRELEASE)/updates/gloss.ko
	$(Q)[ -n "$(DESTDIR)" ] || depmod $(KRELEASE)

.PHONY: check-dkms check-kbuild
check-dkms: ## dkms.conf builds gloss.ko for each Debian kernel here
	$(call quiet,DKMS,driver)
	$(Q)kernels=$$(tests/vm/kernels --release) && \
		{ tests/install/test_dkms.sh $(BUILD)/tests/dkms $$kernels || [ $$? -eq 77 ]; }

check-kbuild: ## make -C KDIR M=$PWD in the top folder builds gloss.ko
	$(call quiet,KBUILD,Kbuild)
	$(Q)tests/install/test_kbuild.sh $(BUILD)/tests/kbuild $(KDIR)

CHECKS += check-dkms check-kbuild

# Static checks. The tools that the headers lack come out of the kernel's sources.
KERNEL_SOURCE ?= $(lastword $(sort $(wildcard /usr/src/linux-source-*.tar.*)))
KERNEL_SCRIPTS := $(BUILD)/kernel/scripts
CHECKPATCH = perl $(KERNEL_SCRIPTS)/checkpatch.pl --no-tree --strict --terse --no-summary --quiet

$(KERNEL_SCRIPTS)/checkpatch.pl:
	$(call quiet,UNPACK,$(KERNEL_SOURCE))
	@mkdir -p $(BUILD)/kernel
	$(Q)tar -xaf $(KERNEL_SOURCE) -C $(BUILD)/kernel --strip-components=1 --wildcards \
		'*/scripts/checkpatch.pl' '*/scripts/spelling.txt' \
		'*/scripts/const_structs.checkpatch' '*/scripts/kernel-doc'
	@touch $@

.PHONY: lint-checkpatch lint-sparse lint-uapi lint-rst
# BIT() is the kernel's own, programs that include the uapi header do not have it; and the
# form of trace events is not that of C.
lint-checkpatch: $(KERNEL_SCRIPTS)/checkpatch.pl ## the kernel's checkpatch on the driver
	$(call quiet,LINT,checkpatch driver)
	$(Q)$(CHECKPATCH) -f driver/Kbuild \
		$(filter-out %/gloss_drm.h %/gloss_trace.h,$(wildcard driver/*.[ch]))
	$(Q)$(CHECKPATCH) --ignore BIT_MACRO -f driver/gloss_drm.h
	$(Q)$(CHECKPATCH) --ignore OPEN_ENDED_LINE,PARENTHESIS_ALIGNMENT -f driver/gloss_trace.h

# sparse only warns, so any word of it fails.
lint-sparse: $(MODULE) ## sparse on the driver
	$(call quiet,LINT,sparse driver)
	@mkdir -p $(BUILD)/check
	$(Q)+$(KBUILD) -s C=2 CHECK=sparse modules >$(BUILD)/check/sparse.log 2>&1; \
		[ $$? -eq 0 ] && [ ! -s $(BUILD)/check/sparse.log ] || \
		{ cat $(BUILD)/check/sparse.log; exit 1; }

# gloss_drm.h for itself, in C and C++; without padding that a compiler chose, and with the
# same offsets for 32-bit programs; documented.
UAPI = echo '\#include "gloss_drm.h"' | $(1) -Wall -Wextra -Werror -Idriver \
	$(patsubst -I%,-isystem %,$(shell pkg-config --cflags libdrm)) -fsyntax-only $(2) -
UAPI_LAYOUT = $(call UAPI,clang --target=$(1)-linux-gnu, -Wpadded -x c \
	-isystem /usr/include/$(shell $(CC) -print-multiarch) \
	-Xclang -fdump-record-layouts-complete -Xclang -fdump-record-layouts-simple) \
	>$(BUILD)/check/layout-$(1).txt

lint-uapi: $(KERNEL_SCRIPTS)/checkpatch.pl ## gloss_drm.h alone: C, C++, 32-bit layout, kernel-doc
	$(call quiet,LINT,gloss_drm.h)
	@mkdir -p $(BUILD)/check
	$(Q)$(call UAPI,$(CC) -std=c99 -pedantic,-x c)
	$(Q)$(call UAPI,$(CXX) -std=c++11 -pedantic,-x c++)
	$(Q)$(call UAPI_LAYOUT,x86_64)
	$(Q)$(call UAPI_LAYOUT,i386)
	$(Q)driver/same-layout $(BUILD)/check/layout-x86_64.txt $(BUILD)/check/layout-i386.txt
	$(Q)perl $(KERNEL_SCRIPTS)/kernel-doc -none -Werror driver/gloss_drm.h

# The texts that the page takes out of the sources are there.
lint-rst: ## each DOC section that driver/gloss.rst names
	$(call quiet,LINT,gloss.rst)
	$(Q)awk '/kernel-doc:: drivers/ { file = $$3; sub(/.*\//, "driver/", file) } \
		sub(/^ *:doc: */, "") { print file "\t" $$0 }' driver/gloss.rst | \
	while IFS="$$(printf '\t')" read -r file name; do \
		grep -qxF " * DOC: $$name" $$file || \
			{ echo "gloss.rst: no section '$$name' in $$file" >&2; exit 1; }; \
	done

LINTS += lint-checkpatch lint-sparse lint-uapi lint-rst
