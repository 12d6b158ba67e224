# SPDX-License-Identifier: MIT
# Static checks, and what spans more than one part of the tree.

# Each parameter at both its ends; the values between differ in nothing but width.
LINT_CORES := 32-1-32 64-2-64 64-4-64 64-8-128 32-8-128

.PHONY: lint-rtl lint-tidy lint-cppcheck
# Not its report of times, which Verilator 5.032 prints to stdout.
lint-rtl: ## verilator -Wall on the core and on the boards around it, at several parameters
	$(call quiet,LINT,rtl)
	$(Q)for core in $(LINT_CORES); do \
		set -- $$(echo $$core | tr - ' '); \
		for top in gloss_core board_pci board_usb; do \
			verilator --lint-only -Wall -sv -Irtl --top-module $$top \
				-GTileSize=$$1 -GPixelsPerClock=$$2 -GStreamBits=$$3 \
				$(BOARD_SOURCES) >/dev/null || exit 1; \
		done; \
	done

LINT_SOURCES = $(sort $(wildcard libaccel/*.c libaccel/*/*.c libaccel/*/*/*.c \
	tools/*.c tools/*/*.c tools/*/*/*.c examples/*.c))
LINT_FLAGS = -std=gnu11 -Ilibaccel -Itools $(LINT_C)

lint-tidy: check-generated ## clang-tidy on the C sources
	$(call quiet,TIDY,libaccel tools)
	@mkdir -p $(BUILD)/check
	$(Q)clang-tidy --quiet $(LINT_SOURCES) -- $(LINT_FLAGS) 2>$(BUILD)/check/tidy.log || \
		{ cat $(BUILD)/check/tidy.log; exit 1; }

# Version 2.17 says of each file that it looks at some branches only. So does 2.10, silently.
lint-cppcheck: check-generated ## cppcheck on the C sources
	$(call quiet,CPPCHECK,libaccel tools)
	$(Q)cppcheck --quiet --std=c11 --enable=warning,performance,portability --inline-suppr \
		--error-exitcode=1 -Ilibaccel -Itools -Idriver --suppress=missingIncludeSystem \
		--suppress=normalCheckLevelMaxBranches \
		$(LINT_SOURCES)

LINTS += lint-rtl lint-tidy lint-cppcheck

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
