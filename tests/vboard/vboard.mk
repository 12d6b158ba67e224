# SPDX-License-Identifier: MIT
# vboard-pci and vboard-usb as a stranger meets them.
##@ Library and tools

.PHONY: vboard vboard-sanitize
vboard: $(BUILD)/vboard-pci $(BUILD)/vboard-usb ## messages and exit codes of vboard-pci and vboard-usb
	$(Q)tests/vboard/run $^

vboard-sanitize: ## tests of the virtual board under ASan, UBSan and TSan
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/asan CFLAGS='$(SANITIZED_CFLAGS)' \
		$(VBOARD_TESTS:%=run-%) $(VBOARD_USB_TESTS:%=run-%)
	$(Q)+TSAN_OPTIONS=halt_on_error=1 $(SANITIZED_MAKE) BUILD=$(BUILD)/tsan \
		CFLAGS='-O1 -g -fsanitize=thread' $(VBOARD_THREAD_TESTS:%=run-%)

CHECKS += vboard vboard-sanitize
