# SPDX-License-Identifier: MIT
# Everything starts here; `make help` lists the targets. Each part of the tree
# brings a fragment (*.mk) with its own rules, which adds to the lists below.

# DEBUG=1 builds for a debugger, in a folder of its own.
DEBUG    ?= 0
BUILD    ?= build$(if $(filter-out 0,$(DEBUG)),/debug)
PREFIX   ?= /usr/local
LIBDIR   ?= $(PREFIX)/lib
DESTDIR  ?=
V        ?= 0
JOBS     ?= $(shell nproc)

CC       ?= cc
CXX      ?= c++
CFLAGS   ?= $(if $(filter-out 0,$(DEBUG)),-O0 -g3 -fno-omit-frame-pointer,-O3 -g)
CXXFLAGS ?= -O3
WARN     := -Wall -Wextra -Wmissing-prototypes -Wshadow -Wvla -Wformat=2
# One rounding per operation on every machine: pictures are compared by their bytes.
ACCEL_CFLAGS := -std=gnu11 $(WARN) -ffp-contract=off -Ilibaccel

comma := ,
empty :=
space := $(empty) $(empty)
define newline


endef

ifeq ($(V),0)
Q := @
quiet = @printf '  %-8s %s\n' '$(1)' '$(2)'
else
Q :=
quiet = @:
endif

# What a C file is compiled with besides: FLAGS_<folder> of each folder it is in, from the root on,
# and FLAGS_<file>. So one rule compiles all of them, and compile_commands.json knows how.
parent  = $(patsubst %/,%,$(dir $(1)))
folders = $(if $(filter-out .,$(call parent,$(1))),$(call folders,$(call parent,$(1))) $(call parent,$(1)))
flags   = $(ACCEL_CFLAGS) $(foreach place,$(call folders,$(1)) $(1),$(FLAGS_$(place)))

# $(1): compiler, $(2): its options
define compile
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(1) $(call flags,$<) $(2) -MMD -MP -c $< -o $@
endef

# Of what a program needs, the objects and archives; LIBS and WRAPS are its own, private to it.
define link
	$(call quiet,LD,$@)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $(filter %.o,$^) $(filter %.a,$^) $(WRAPS) $(LIBS) -o $@
endef

# The core; rtl/port and rtl/board stand around it.
RTL_SOURCES = rtl/gloss_pkg.sv $(filter-out rtl/port/% rtl/board/%,$(sort $(wildcard rtl/lib/*.sv rtl/*/*.sv))) \
	rtl/gloss_core.sv

# Benches and simulators stop where a contract of the RTL is broken.
VERILATE := verilator --cc --exe --build --assert

# What the fragments add to.
ALL        :=
UNIT_TESTS :=
CHECKS     :=
LINTS      :=
INSTALLS   :=

.DEFAULT_GOAL := all
.SUFFIXES:
.DELETE_ON_ERROR:
.SECONDARY:

# The product, whose fragments know of no test.
include libaccel/libaccel.mk
include rtl/board/board.mk
include tools/tools.mk
include mesa_shim/shim.mk
include driver/driver.mk

# Tests, in the order in which they need each other's objects.
include $(addprefix tests/,stream/stream.mk port/port.mk usb/usb.mk unit/unit.mk gl/oracle.mk decode/decode.mk \
	hwgen/hwgen.mk gl/gl.mk gl/programs.mk view/view.mk image/image.mk bench/bench.mk info/info.mk vboard/vboard.mk \
	rtl/raster.mk rtl/command.mk rtl/tile.mk rtl/port.mk synth/synth.mk stream/grammar.mk fuzz/fuzz.mk \
	fuzz/fuzz_draw.mk fuzz/fuzz_usb.mk vm/vm.mk install/install.mk abi/abi.mk docs/docs.mk tests.mk lint.mk)

$(BUILD)/%.o: %.c $(BUILD)/flags
	$(call compile,$(CC),$(CFLAGS))

# Everything is compiled anew when the compiler or its options are others; what depends on the place
# the library is installed to, and on the version, is rebuilt by itself.
$(BUILD)/flags: export TEXT = $(CC) $(CFLAGS) $(LDFLAGS) $(ACCEL_CFLAGS) $(foreach name,$(sort \
	$(filter-out %.c,$(filter FLAGS_%,$(.VARIABLES)))),$(name)=$($(name)))
$(BUILD)/flags: FORCE
	@mkdir -p $(@D)
	@printf '%s\n' "$$TEXT" | cmp -s - $@ || printf '%s\n' "$$TEXT" >$@

# How each C file is compiled, for clangd, which looks for it here, and for clang-tidy.
command = {"directory": "$(CURDIR)", "file": "$(1)", "command": "$(subst ",\",$(strip $(CC) \
	$(call flags,$(1)) $(CFLAGS) -c $(1)))"}
$(BUILD)/compile_commands.json: $(BUILD)/flags FORCE
	$(file >$@,[$(subst }$(space){,}$(comma)$(newline){,$(foreach source,$(C_SOURCES),$(call command,$(source))))])

.PHONY: compile-commands FORCE
##@ Building
compile-commands: $(BUILD)/compile_commands.json ## write build/compile_commands.json, for clangd

FORCE:

C_SOURCES := $(wildcard $(addsuffix /*.c,libaccel libaccel/* libaccel/*/* mesa_shim/* tools/* tools/*/* tests/* \
	tests/unit/* tests/vm/runner examples))
-include $(foreach folder,$(sort $(dir $(C_SOURCES))),$(wildcard $(BUILD)/$(folder)*.d \
	$(BUILD)/fuzz/*/$(folder)*.d))

##@ Building

.PHONY: all deps demo check unit lint install clean help

all: $(ALL) ## build the library, the simulator plugin and the tools

deps: ## install the Debian packages everything here needs (asks for root)
	$(Q)tools/install-deps

demo: ## draw the bunny on the Verilated core and on the model, and compare
	$(Q)$(MAKE) --no-print-directory -j$(JOBS) all
	$(Q)$(MAKE) --no-print-directory demo-run

##@ Checking everything

unit: $(UNIT_TESTS:%=run-%) ## unit tests of the library, the model and the tools

check: ## all tests that need no hardware
	$(Q)tests/check $(JOBS) $(BUILD) check-generated unit $(CHECKS) lint

lint: $(LINTS) ## static checks: the lint- targets below

##@ Building

install: all $(INSTALLS) ## install library, headers, tools, man pages (PREFIX, DESTDIR)

clean: ## remove everything that was built
	$(Q)rm -rf $(BUILD)

# In groups: a line "##@ NAME" begins one, or goes on with it.
help: ## this list
	$(Q)awk 'FNR == 1 { group = "More" } sub(/^##@ /, "") { group = $$0 } \
		match($$0, /^[a-z][a-z-]*:.*## /) { \
			if (!(group in of)) order[++groups] = group; \
			of[group] = of[group] sprintf("  %-18s %s\n", \
				substr($$0, 1, index($$0, ":") - 1), substr($$0, RLENGTH + 1)) } \
		END { for (n = 1; n <= groups; n++) \
			printf("%s%s:\n%s", (n == 1) ? "" : "\n", order[n], of[order[n]]) }' $(MAKEFILE_LIST)
