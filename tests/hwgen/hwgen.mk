# SPDX-License-Identifier: MIT
# What hwgen writes, and what it refuses.
##@ The interface

$(BUILD)/tests/hwgen/test_small: $(BUILD)/tests/hwgen/test_small.o

.PHONY: run-hwgen refresh-hwgen
run-hwgen: $(BUILD)/tests/hwgen/test_small $(HWGEN)
	$(call quiet,TEST,hwgen)
	$(Q)$(BUILD)/tests/hwgen/test_small
	$(Q)tests/hwgen/run $(HWGEN) $(BUILD)

refresh-hwgen: $(HWGEN) ## make what hwgen does now the expected; read the diff
	$(Q)tests/hwgen/run $(HWGEN) $(BUILD) --refresh

UNIT_TESTS += hwgen
