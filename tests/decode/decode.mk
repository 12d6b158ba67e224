# SPDX-License-Identifier: MIT
# gloss-decode as a stranger meets it, after the tests of its insides.

.PHONY: run-decode
run-decode: $(BUILD)/gloss-decode $(DECODE_UNIT_TESTS:%=run-%)
	$(call quiet,TEST,gloss-decode)
	$(Q)tests/decode/run $(BUILD)/gloss-decode $(BUILD)

UNIT_TESTS += decode
