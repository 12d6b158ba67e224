# SPDX-License-Identifier: MIT
# Everything starts here; `make help` lists the targets. Each part of the tree
# brings a fragment (*.mk) with its own rules, which adds to the lists below.

BUILD    ?= build
PREFIX   ?= /usr/local
LIBDIR   ?= $(PREFIX)/lib
DESTDIR  ?=
V        ?= 0
JOBS     ?= $(shell nproc)

CC       ?= cc
CXX      ?= c++
CFLAGS   ?= -O3 -g
CXXFLAGS ?= -O3
WARN     := -Wall -Wextra -Wmissing-prototypes -Wshadow -Wvla -Wformat=2
# One rounding per operation on every machine: pictures are compared by their bytes.
ACCEL_CFLAGS := -std=gnu11 $(WARN) -ffp-contract=off -Ilibaccel

ifeq ($(V),0)
Q := @
quiet = @printf '  %-8s %s\n' '$(1)' '$(2)'
else
Q :=
quiet = @:
endif

# The core; rtl/port and rtl/board stand around it.
RTL_SOURCES = rtl/gloss_pkg.sv $(filter-out rtl/port/% rtl/board/%,$(sort $(wildcard rtl/lib/*.sv rtl/*/*.sv))) \
	rtl/gloss_core.sv

# Benches and simulators stop where a contract of the RTL is broken.
VERILATE := verilator --cc --exe --build --assert

# Programs of unit tests by their names, which are unique: tests lie in folders as what they test.
unit = $(foreach test,$(1),$(patsubst %.c,$(BUILD)/%,$(or $(wildcard tests/unit/$(test).c \
	tests/unit/*/$(test).c tests/usb/$(test).c),$(error no unit test $(test)))))

# What the fragments add to.
ALL        :=
UNIT_TESTS :=
CHECKS     :=
LINTS      :=
INSTALLS   :=
LINT_C     :=

.DEFAULT_GOAL := all
.SUFFIXES:
.DELETE_ON_ERROR:
.SECONDARY:

include tools/scene/scene.mk
include tools/hwgen/hwgen.mk
include tools/decode/decode.mk
include libaccel/model/model.mk
include libaccel/draw/draw.mk
include libaccel/libaccel.mk
include tools/view/view.mk
include tools/info/info.mk
include rtl/raster/raster.mk
include rtl/command/command.mk
include rtl/tile/tile.mk
include rtl/port/port.mk
include driver/driver.mk
include tools/vboard/vboard.mk
include tests/stream/stream.mk
include tests/usb/usb.mk
include tests/vm/vm.mk
include tests/docs/docs.mk
include tests/tests.mk

.PHONY: all deps demo check unit lint install clean help

all: $(ALL) ## build the library, the simulator plugin and the tools

deps: ## install the Debian packages everything here needs (asks for root)
	$(Q)tools/install-deps

demo: ## draw the bunny on the Verilated core and on the model, and compare
	$(Q)$(MAKE) --no-print-directory -j$(JOBS) all
	$(Q)$(MAKE) --no-print-directory demo-run

unit: $(UNIT_TESTS:%=run-%) ## unit tests of the library, the model and the tools

check: ## all tests that need no hardware
	$(Q)tests/check $(JOBS) $(BUILD) check-generated unit $(CHECKS) lint

lint: $(LINTS) ## static checks: verilator -Wall, clang-tidy, cppcheck

install: all $(INSTALLS) ## install library, headers, tools, man pages (PREFIX, DESTDIR)

clean: ## remove everything that was built
	$(Q)rm -rf $(BUILD)

help: ## this list
	$(Q)grep -hE '^[a-z][a-z-]*:.*## ' $(MAKEFILE_LIST) | sort | sed -E 's/^([a-z-]+):.*## /\1\t/' | expand -t 18
