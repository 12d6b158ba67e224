# SPDX-License-Identifier: MIT
# gloss-decode as a stranger meets it, after the test of its insides.

.PHONY: run-decode
run-decode: $(BUILD)/gloss-decode run-test_decode
	$(call quiet,TEST,gloss-decode)
	$(Q)tests/decode/run $(BUILD)/gloss-decode $(BUILD)

UNIT_TESTS += decode
