# SPDX-License-Identifier: MIT
# Benches of fragment, tile and memory.

TILE_MODEL := $(addprefix $(BUILD)/libaccel/model/,fragment.o command.o)

# The ends of the parameters for every check, all that are built in the longer target.
TILE_CORES := 32-1 64-8
TILE_ALL_CORES := 64-1 64-2 64-4 64-8 32-1 32-2 32-4 32-8

# $(1) stage, $(2) tile size, $(3) lanes, $(4) more sources, $(5) objects
define tile_bench
$(BUILD)/rtl/$(1)-$(2)-$(3)/bench: tests/rtl/tb_$(1).cpp tests/rtl/tb.h $(4) \
		$(wildcard rtl/$(1)/*.sv) rtl/gloss_pkg.sv rtl/gloss_hw.svh $(5)
	$$(call quiet,RTL,$$@)
	$(Q)mkdir -p $$(@D)
	$(Q)verilator --cc --exe --build -O3 --x-assign unique --x-initial unique --top-module $(1) \
		-GTileSize=$(2) -GPixelsPerClock=$(3) -Irtl --Mdir $$(@D) -o bench \
		-MAKEFLAGS "OPT_FAST=-O2 OPT_SLOW=-O0" \
		-CFLAGS "-DTILE=$(2) -DLANES=$(3) -I$$(CURDIR)/libaccel" \
		rtl/gloss_pkg.sv $(4) $(wildcard rtl/$(1)/*.sv) $$(CURDIR)/tests/rtl/tb_$(1).cpp \
		$$(addprefix $$(CURDIR)/,$(5)) >$$(@D)/log || { cat $$(@D)/log; exit 1; }
endef
$(foreach core,$(TILE_ALL_CORES), \
	$(eval $(call tile_bench,fragment,$(word 1,$(subst -, ,$(core))),$(word 2,$(subst -, ,$(core))),,$(BUILD)/libaccel/model/fragment.o)))

.PHONY: rtl-fragment
rtl-fragment: $(TILE_CORES:%=$(BUILD)/rtl/fragment-%/bench) ## depth test, masks and counters against the model
	$(Q)for bench in $^; do $$bench || exit 1; done

CHECKS += rtl-fragment
