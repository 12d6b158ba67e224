# SPDX-License-Identifier: MIT
# What spans more than one part of the tree.
##@ Checking everything

# Tests find each other's helpers.
FLAGS_tests := -Itools -Idriver -pthread $(addprefix -Itests/,unit stream port usb)
FLAGS_tests/unit/object := $(USB_CFLAGS)
FLAGS_tests/unit/transport := $(DRM_CFLAGS) $(USB_CFLAGS)

# A test program is its own object, with what it needs besides as prerequisites.
$(BUILD)/tests/%: private LIBS = -lcmocka $(ACCEL_LIBS)
$(BUILD)/tests/%: $(BUILD)/tests/%.o
	$(link)

# Not among the checks: it needs root and a mirror, and takes as long as all of them twice.
.PHONY: check-fresh
check-fresh: ## the README's commands on a bare Debian; needs root (SUITE: trixie or bookworm; WHO: root or user, both)
	$(Q)tests/fresh "$(SUITE)" $(or $(GLOSS_CACHE),$(BUILD)) $(BUILD)/fresh $(WHO)

# tests/check asks for checked-TARGET; the line in the file is the proof that TARGET ran and passed.
# It wants to know what takes long, so each line of a recipe is run by tests/timed.
ifneq ($(CHECKED),)
SHELL = tests/timed $(BUILD)/check/times $@
endif
define checked_rule
.PHONY: checked-$(1)
checked-$(1): $(1)
	@echo $(1) >> $(BUILD)/check/passed
endef
$(foreach target,$(CHECKED),$(eval $(call checked_rule,$(target))))
