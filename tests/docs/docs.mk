# SPDX-License-Identifier: MIT
# What documents say, where a program can tell whether it is true.

.PHONY: test-version test-links print-version
test-version: ## one version everywhere: that of the file VERSION
	$(call quiet,TEST,version)
	$(Q)tests/docs/version

test-links: ## the files that documents name are there
	$(call quiet,TEST,links)
	$(Q)tests/docs/links

print-version:
	@echo $(ACCEL_VERSION)

CHECKS += test-version test-links
