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

# BTF of a module needs the kernel's own vmlinux, which the headers do not bring.
KBUILD = $(MAKE) --no-print-directory $(if $(filter 0,$(V)),-s) -C $(KDIR) \
	M=$(abspath $(MODULE_BUILD)) W=1 KCFLAGS=-Werror CONFIG_DEBUG_INFO_BTF_MODULES=

.PHONY: module install-module FORCE
module: $(MODULE) ## build gloss.ko (KDIR: for which kernel, MODULE_BUILD: where)

$(MODULE): $(MODULE_SOURCES) $(MODULE_BUILD)/kdir
	$(call quiet,KBUILD,$@)
	$(Q)ln -sf $(abspath $(MODULE_SOURCES)) $(MODULE_BUILD)/
	$(Q)$(KBUILD) modules
	@touch $@

$(MODULE_BUILD)/kdir: FORCE
	@[ -e "$(KDIR)/Makefile" ] || { \
		echo "gloss.ko: no headers of a kernel here; run 'make deps', or give KDIR" >&2; \
		exit 1; }
	@mkdir -p $(@D)
	@echo $(KDIR) | cmp -s - $@ || echo $(KDIR) >$@

install-module: $(MODULE) ## install gloss.ko for the kernel of KDIR (DESTDIR)
	$(Q)$(KBUILD) INSTALL_MOD_PATH=$(DESTDIR) modules_install
