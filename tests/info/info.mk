# SPDX-License-Identifier: MIT
# gloss-info as a stranger meets it, and the udev rule.
##@ Library and tools

# gloss-info on boards that no machine has.
$(BUILD)/tests/info/fake: private LIBS :=
$(BUILD)/tests/info/fake: $(INFO_OBJECTS) $(DEVICE_OBJECT) $(BUILD)/tests/info/fake_accel.o
	$(link)

.PHONY: info info-sanitize run-udev
info: $(BUILD)/gloss-info $(BUILD)/tests/info/fake ## gloss-info's messages, exit codes and JSON
	$(Q)tests/info/run $(abspath $^) $(BUILD)/tests/info

info-sanitize: ## the same under ASan and UBSan
	$(Q)+$(SANITIZED_MAKE) BUILD=$(BUILD)/asan CFLAGS='$(SANITIZED_CFLAGS)' info

run-udev:
	$(call quiet,TEST,udev)
	$(Q)tests/info/test_udev.sh

UNIT_TESTS += udev
CHECKS += info info-sanitize
