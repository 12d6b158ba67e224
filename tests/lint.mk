# SPDX-License-Identifier: MIT
# Static checks, of which each is a target of its own: make -j lint runs them side by side.
##@ Static checks

# Each parameter at both its ends; the values between differ in nothing but width.
LINT_CORES := 32-1-32 64-2-64 64-4-64 64-8-128 32-8-128

.PHONY: lint-rtl lint-style lint-tidy lint-cppcheck
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

lint-style: ## instances of the RTL in one form, lines up to 100 columns
	$(call quiet,LINT,rtl style)
	$(Q)tests/rtl/style

# All of C but the driver's, which has the kernel's tools below.
lint-tidy: $(BUILD)/compile_commands.json check-generated $(GL_CALLS_INC) ## clang-tidy on the C sources, tests too
	$(call quiet,TIDY,libaccel mesa_shim tools tests)
	@mkdir -p $(BUILD)/check
	$(Q)printf '%s\n' $(C_SOURCES) | xargs -P $(JOBS) -n 8 clang-tidy --quiet -p $(BUILD) \
		2>$(BUILD)/check/tidy.log || { cat $(BUILD)/check/tidy.log; exit 1; }

# Version 2.17 says of each file that it looks at some branches only. So does 2.10, silently, which takes
# the members of a struct among arguments for assignments. A test may end by a signal without memory; and
# 2.17 takes words for unset that one argument of a call packs for another.
lint-cppcheck: check-generated ## cppcheck on the C sources, tests too
	$(call quiet,CPPCHECK,libaccel mesa_shim tools tests)
	$(Q)cppcheck -j $(JOBS) --quiet --std=c11 --enable=warning,performance,portability --inline-suppr \
		--error-exitcode=1 -Ilibaccel -Imesa_shim -Idriver $(filter -I%,$(FLAGS_tests)) \
		--suppress=missingIncludeSystem --suppress=normalCheckLevelMaxBranches \
		$(patsubst %,'--suppress=%:tests/*',unknownEvaluationOrder uninitvar \
			nullPointerOutOfMemory nullPointerArithmeticOutOfMemory) $(C_SOURCES)

# All of C but what is generated, the README's program and the kernel's.
FORMAT_SOURCES = $(filter-out libaccel/gloss_packets.h tools/decode/gloss_table.h tests/hwgen/% examples/% \
	$(GL_GENERATED:%=mesa_shim/api/%), \
	$(C_SOURCES) $(wildcard $(addsuffix *.h,$(sort $(dir $(C_SOURCES))))))
.PHONY: lint-format format
lint-format: ## clang-format on the C sources; make format does what it says
	$(call quiet,LINT,clang-format)
	$(Q)clang-format --dry-run -Werror $(FORMAT_SOURCES)

format: ## put the C sources into the form of .clang-format
	$(Q)clang-format -i $(FORMAT_SOURCES)

LINTS += lint-rtl lint-style lint-tidy lint-cppcheck lint-format

# ---- the driver ----

# The tools that the headers lack come out of the kernel's sources.
KERNEL_SOURCE ?= $(lastword $(sort $(wildcard /usr/src/linux-source-*.tar.*)))
KERNEL_SCRIPTS := $(BUILD)/kernel/scripts
CHECKPATCH = perl $(KERNEL_SCRIPTS)/checkpatch.pl --no-tree --strict --terse --no-summary --quiet

$(KERNEL_SCRIPTS)/checkpatch.pl:
	$(call quiet,UNPACK,$(KERNEL_SOURCE))
	@mkdir -p $(BUILD)/kernel
	$(Q)tar -xaf $(KERNEL_SOURCE) -C $(BUILD)/kernel --strip-components=1 --wildcards \
		'*/scripts/checkpatch.pl' '*/scripts/spelling.txt' \
		'*/scripts/const_structs.checkpatch' '*/scripts/kernel-doc'
	@touch $@

.PHONY: lint-checkpatch lint-sparse lint-uapi lint-rst
# BIT() is the kernel's own, programs that include the uapi header do not have it; and the
# form of trace events is not that of C.
lint-checkpatch: $(KERNEL_SCRIPTS)/checkpatch.pl ## the kernel's checkpatch on the driver
	$(call quiet,LINT,checkpatch driver)
	$(Q)$(CHECKPATCH) -f driver/Kbuild \
		$(filter-out %/gloss_drm.h %/gloss_trace.h,$(wildcard driver/*.[ch]))
	$(Q)$(CHECKPATCH) --ignore BIT_MACRO -f driver/gloss_drm.h
	$(Q)$(CHECKPATCH) --ignore OPEN_ENDED_LINE,PARENTHESIS_ALIGNMENT -f driver/gloss_trace.h

# sparse only warns, so any word of it fails.
lint-sparse: $(MODULE) ## sparse on the driver
	$(call quiet,LINT,sparse driver)
	@mkdir -p $(BUILD)/check
	$(Q)+$(KBUILD) -s C=2 CHECK=sparse modules >$(BUILD)/check/sparse.log 2>&1; \
		[ $$? -eq 0 ] && [ ! -s $(BUILD)/check/sparse.log ] || \
		{ cat $(BUILD)/check/sparse.log; exit 1; }

# gloss_drm.h for itself, in C and C++; without padding that a compiler chose, and with the
# same offsets for 32-bit programs; documented.
UAPI = echo '\#include "gloss_drm.h"' | $(1) -Wall -Wextra -Werror -Idriver \
	$(patsubst -I%,-isystem %,$(shell pkg-config --cflags libdrm)) -fsyntax-only $(2) -
UAPI_LAYOUT = $(call UAPI,clang --target=$(1)-linux-gnu, -Wpadded -x c \
	-isystem /usr/include/$(shell $(CC) -print-multiarch) \
	-Xclang -fdump-record-layouts-complete -Xclang -fdump-record-layouts-simple) \
	>$(BUILD)/check/layout-$(1).txt

lint-uapi: $(KERNEL_SCRIPTS)/checkpatch.pl ## gloss_drm.h alone: C, C++, 32-bit layout, kernel-doc
	$(call quiet,LINT,gloss_drm.h)
	@mkdir -p $(BUILD)/check
	$(Q)$(call UAPI,$(CC) -std=c99 -pedantic,-x c)
	$(Q)$(call UAPI,$(CXX) -std=c++11 -pedantic,-x c++)
	$(Q)$(call UAPI_LAYOUT,x86_64)
	$(Q)$(call UAPI_LAYOUT,i386)
	$(Q)driver/same-layout $(BUILD)/check/layout-x86_64.txt $(BUILD)/check/layout-i386.txt
	$(Q)perl $(KERNEL_SCRIPTS)/kernel-doc -none -Werror driver/gloss_drm.h

# The texts that the page takes out of the sources are there.
lint-rst: ## each DOC section that driver/gloss.rst names
	$(call quiet,LINT,gloss.rst)
	$(Q)awk '/kernel-doc:: drivers/ { file = $$3; sub(/.*\//, "driver/", file) } \
		sub(/^ *:doc: */, "") { print file "\t" $$0 }' driver/gloss.rst | \
	while IFS="$$(printf '\t')" read -r file name; do \
		grep -qxF " * DOC: $$name" $$file || \
			{ echo "gloss.rst: no section '$$name' in $$file" >&2; exit 1; }; \
	done

LINTS += lint-checkpatch lint-sparse lint-uapi lint-rst
