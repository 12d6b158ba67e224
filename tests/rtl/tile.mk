# SPDX-License-Identifier: MIT
# Benches of fragment, tile and memory.
##@ RTL

# The corners of the parameters for every check, all that are built in the longer target.
TILE_CORES := 32-1 64-1 32-8 64-8
TILE_ALL_CORES := 64-1 64-2 64-4 64-8 32-1 32-2 32-4 32-8

# $(1) stage, $(2) tile size, $(3) lanes, $(4) more sources, $(5) objects
define tile_bench
$(BUILD)/rtl/$(1)-$(2)-$(3)/bench: tests/rtl/tb_$(1).cpp $(wildcard tests/rtl/$(1)_*.h) tests/rtl/tb.h $(4) \
		$(wildcard rtl/$(1)/*.sv) rtl/gloss_pkg.sv rtl/gloss_hw.svh $(5)
	$$(call quiet,RTL,$$@)
	$(Q)mkdir -p $$(@D)
	$(Q)$(VERILATE) -O3 --x-assign unique --x-initial unique --top-module $(1) \
		-GTileSize=$(2) -GPixelsPerClock=$(3) -Irtl --Mdir $$(@D) -o bench \
		-MAKEFLAGS "OPT_FAST=-O2 OPT_SLOW=-O0" \
		-CFLAGS "-DTILE=$(2) -DLANES=$(3) -I$$(CURDIR)/libaccel" \
		rtl/gloss_pkg.sv $(4) $(wildcard rtl/$(1)/*.sv) $$(CURDIR)/tests/rtl/tb_$(1).cpp \
		$$(addprefix $$(CURDIR)/,$(5)) >$$(@D)/log || { cat $$(@D)/log; exit 1; }
endef
define tile_benches
$(call tile_bench,fragment,$(1),$(2),,$(BUILD)/libaccel/model/fragment.o)
$(call tile_bench,tile,$(1),$(2),rtl/lib/ram_1r1w.sv rtl/lib/ram_fifo.sv rtl/lib/stream_register.sv)
$(call tile_bench,memory,$(1),$(2),rtl/lib/ram_1r1w.sv rtl/lib/axi_rules.sv rtl/lib/stream_register.sv)
endef
$(foreach core,$(TILE_ALL_CORES),$(eval $(call tile_benches,$(firstword $(subst -, ,$(core))),$(lastword $(subst -, ,$(core))))))

.PHONY: rtl-fragment rtl-tile rtl-memory rtl-tile-all formal
rtl-fragment: $(TILE_CORES:%=$(BUILD)/rtl/fragment-%/bench) ## depth test, masks and counters against the model
	$(Q)for bench in $^; do $$bench || exit 1; done

rtl-tile: $(TILE_CORES:%=$(BUILD)/rtl/tile-%/bench) ## clear, load, store, answer in stream order, with random stalls
	$(Q)for bench in $^; do $$bench || exit 1; done

rtl-memory: $(TILE_CORES:%=$(BUILD)/rtl/memory-%/bench) ## copies of all alignments, AXI4 rules, errors
	$(Q)for bench in $^; do $$bench || exit 1; done

rtl-tile-all: $(foreach stage,fragment tile memory,$(TILE_ALL_CORES:%=$(BUILD)/rtl/$(stage)-%/bench)) ## the three for every core that is built, and longer
	$(Q)for bench in $^; do $$bench 400 || exit 1; done

formal: ## proofs: memory_burst, for all ranges
	$(Q)tests/formal/prove $(BUILD) 20 formal_memory_burst tests/formal/formal_memory_burst.sv \
		rtl/memory/memory_burst.sv

CHECKS += rtl-fragment rtl-tile rtl-memory formal
