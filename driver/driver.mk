# SPDX-License-Identifier: MIT
# The kernel module gloss.ko, built outside its sources. KDIR is the kernel to build for and MODULE_BUILD the place; both
# can be given, as tests/vm does for its own kernel.
##@ Building

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

.PHONY: module install-module
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
