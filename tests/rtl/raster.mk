# SPDX-License-Identifier: MIT
# Benches of raster and shade, and what the core takes on real devices.
##@ RTL

RASTER_SOURCES = rtl/gloss_pkg.sv $(sort $(wildcard rtl/raster/*.sv rtl/shade/*.sv)) \
	rtl/lib/stream_fifo.sv
RASTER_MODEL := $(addprefix $(BUILD)/libaccel/model/,triangle.o triangle_small.o raster.o shade.o)
RASTER_TB = tests/rtl/tb.h tests/rtl/raster_record.h

# The ends of the parameters for every check, all that are built in the longer target.
RASTER_CORES := 32-1-32 64-4-64 64-8-128
RASTER_ALL_CORES := 64-1-32 64-2-64 64-4-64 64-8-128 32-1-32 32-2-64 32-4-64 32-8-128

# $(1): module, $(2): its sources and objects of the bench, $(3): flags for Verilator, $(4): macros
define raster_bench
	$(call quiet,RTL,$@)
	$(Q)mkdir -p $(@D)
	$(Q)$(VERILATE) -O3 --x-assign unique --x-initial unique --top-module $(1) \
		$(3) -Irtl --Mdir $(@D) -o bench -MAKEFLAGS "OPT_FAST=-O1 OPT_SLOW=-O0" \
		-CFLAGS "$(4) -I$(CURDIR)/libaccel" $(2) $(CURDIR)/tests/rtl/tb_$(1).cpp >$(@D)/log || \
		{ cat $(@D)/log; exit 1; }
endef
raster_core = $(subst -, ,$(1))
raster_set = -GTileSize=$(word 1,$(1)) -GPixelsPerClock=$(word 2,$(1)) -GStreamBits=$(word 3,$(1))
raster_define = -DTILE=$(word 1,$(1)) -DLANES=$(word 2,$(1)) -DSTREAM=$(word 3,$(1))

$(BUILD)/rtl/raster-%/bench: tests/rtl/tb_raster_shade.cpp $(RASTER_TB) $(RASTER_SOURCES) \
		rtl/gloss_hw.svh $(RASTER_MODEL)
	$(call raster_bench,raster_shade,$(RASTER_SOURCES) $(RASTER_MODEL:%=$(CURDIR)/%),$(call \
		raster_set,$(call raster_core,$*)),$(call raster_define,$(call raster_core,$*)))

$(BUILD)/rtl/edge/bench: tests/rtl/tb_raster_edge.cpp $(RASTER_TB) rtl/raster/raster_edge.sv \
		rtl/gloss_hw.svh
	$(call raster_bench,raster_edge,rtl/gloss_pkg.sv rtl/raster/raster_edge.sv)

SURFACE_SOURCES = rtl/gloss_pkg.sv $(wildcard rtl/shade/shade_surface*.sv)
$(BUILD)/rtl/surface-%/bench: tests/rtl/tb_shade_surface.cpp tests/rtl/tb.h $(SURFACE_SOURCES) \
		rtl/gloss_hw.svh
	$(call raster_bench,shade_surface,$(SURFACE_SOURCES),-GPixelsPerClock=$*,-DLANES=$*)

# The same bench on what yosys reads: its reader takes some of the language differently, and says nothing.
$(BUILD)/rtl/read-%/raster_shade.v: $(RASTER_SOURCES) rtl/gloss_hw.svh
	$(call quiet,YOSYS,$@)
	$(Q)mkdir -p $(@D)
	$(Q)yosys -q -p "read_verilog -sv -Irtl $(RASTER_SOURCES); \
		chparam $(subst -G,-set ,$(subst =, ,$(call raster_set,$(call raster_core,$*)))) raster_shade; \
		hierarchy -top raster_shade; proc; flatten; opt; rename -top raster_shade; \
		write_verilog -noattr $@" >$(@D)/yosys.log 2>&1 || { cat $(@D)/yosys.log; exit 1; }

$(BUILD)/rtl/read-%/bench: $(BUILD)/rtl/read-%/raster_shade.v tests/rtl/tb_raster_shade.cpp \
		$(RASTER_TB) $(RASTER_MODEL)
	$(call raster_bench,raster_shade,$< $(RASTER_MODEL:%=$(CURDIR)/%),-Wno-fatal -Wno-lint \
		-Wno-style -Wno-UNOPTFLAT,$(call raster_define,$(call raster_core,$*)))

RASTER_BENCHES = $(BUILD)/rtl/edge/bench $(addprefix $(BUILD)/rtl/,surface-1/bench surface-8/bench)

.PHONY: rtl-raster rtl-raster-read rtl-raster-all
rtl-raster: $(RASTER_BENCHES) $(RASTER_CORES:%=$(BUILD)/rtl/raster-%/bench) ## raster and shade against the model
	$(Q)for bench in $^; do $$bench || exit 1; done

rtl-raster-read: $(BUILD)/rtl/read-64-8-128/bench ## the same on raster and shade as yosys reads them
	$(Q)$< 10

RASTER_ALL_BENCHES = $(RASTER_BENCHES) $(addprefix $(BUILD)/rtl/,surface-2/bench surface-4/bench) \
	$(foreach core,$(RASTER_ALL_CORES),$(BUILD)/rtl/raster-$(core)/bench $(BUILD)/rtl/read-$(core)/bench)
rtl-raster-all: $(RASTER_ALL_BENCHES) ## the same for every core that is built, and longer
	$(Q)for bench in $^; do $$bench 1000 || exit 1; done

CHECKS += rtl-raster rtl-raster-read
