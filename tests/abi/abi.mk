# SPDX-License-Identifier: MIT
# What programs that exist were compiled with.

##@ Library and tools
.PHONY: test-abi
test-abi: $(BUILD)/libaccel.so ## structs of accel.h are as programs have them, and may grow
	$(call quiet,TEST,abi)
	$(Q)tests/abi/layout $(BUILD)
	$(Q)tests/abi/versions $(BUILD)

CHECKS += test-abi
