# SPDX-License-Identifier: MIT
# What is installed is enough to build and run programs; the module's other ways to be built.
##@ Library and tools

.PHONY: test-install test-readme check-dkms check-kbuild
test-install: lib $(ACCEL_SIMS) ## install the library to a directory, and use it from there
	$(Q)rm -rf $(BUILD)/tests/install/root
	$(Q)+$(MAKE) --no-print-directory install-lib DESTDIR=$(BUILD)/tests/install/root
	$(Q)tests/install/test_install.sh $(BUILD)/tests/install/root $(PREFIX) $(LIBDIR) \
		"$(SIM_CORES)"

SHIM_STAGE := $(abspath $(BUILD))/tests/install/shim
.PHONY: test-install-shim
test-install-shim: shim ## install the OpenGL vendor library, have libglvnd find it, uninstall it
	$(call quiet,TEST,install-shim)
	$(Q)rm -rf $(SHIM_STAGE)
	$(Q)+$(MAKE) -s install-shim DESTDIR=$(SHIM_STAGE)
	$(Q)+tests/gl/with_xvfb 24 tests/install/test_install_shim.sh $(SHIM_STAGE) $(LIBDIR) $(GL_DATADIR) "$(MAKE)"

ifneq ($(GL_FOUND),)
CHECKS += test-install-shim
endif

test-readme: ## the README's program is the example
	$(Q)tests/install/test_readme.sh $(BUILD)/tests/install

check-dkms: ## dkms.conf builds gloss.ko for each Debian kernel here
	$(call quiet,DKMS,driver)
	$(Q)kernels=$$(tests/vm/kernels --release) && \
		{ tests/install/test_dkms.sh $(BUILD)/tests/dkms $$kernels || [ $$? -eq 77 ]; }

check-kbuild: ## make -C KDIR M=$PWD in the top folder builds gloss.ko
	$(call quiet,KBUILD,Kbuild)
	$(Q)tests/install/test_kbuild.sh $(BUILD)/tests/kbuild $(KDIR)

CHECKS += test-install test-readme check-dkms check-kbuild
