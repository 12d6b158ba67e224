# SPDX-License-Identifier: MIT
# Benches of raster and shade.

RASTER_SOURCES = rtl/gloss_pkg.sv $(sort $(wildcard rtl/raster/*.sv rtl/shade/*.sv)) rtl/lib/stream_register.sv
RASTER_MODEL := $(addprefix $(BUILD)/libaccel/model/,triangle.o raster.o shade.o)

# The ends of the parameters for every check, all that are built in the longer target.
RASTER_CORES := 32-1-32 64-4-64 64-8-128
RASTER_ALL_CORES := 64-1-32 64-2-64 64-4-64 64-8-128 32-1-32 32-2-64 32-4-64 32-8-128

define raster_bench
$(BUILD)/rtl/raster-$(1)/bench: tests/rtl/tb_raster_shade.cpp tests/rtl/raster_record.h tests/rtl/tb.h \
		$(RASTER_SOURCES) rtl/gloss_hw.svh $(RASTER_MODEL)
	$$(call quiet,RTL,$$@)
	$(Q)mkdir -p $$(@D)
	$(Q)verilator --cc --exe --build -O3 --x-assign unique --x-initial unique --top-module raster_shade \
		-GTileSize=$(word 1,$(2)) -GPixelsPerClock=$(word 2,$(2)) -GStreamBits=$(word 3,$(2)) -Irtl \
		--Mdir $$(@D) -o bench -MAKEFLAGS "OPT_FAST=-O1 OPT_SLOW=-O0" \
		-CFLAGS "-DTILE=$(word 1,$(2)) -DLANES=$(word 2,$(2)) -DSTREAM=$(word 3,$(2)) -I$$(CURDIR)/libaccel" \
		$(RASTER_SOURCES) $$(CURDIR)/tests/rtl/tb_raster_shade.cpp $$(RASTER_MODEL:%=$$(CURDIR)/%) \
		>$$(@D)/log || { cat $$(@D)/log; exit 1; }
endef
$(foreach core,$(RASTER_ALL_CORES),$(eval $(call raster_bench,$(core),$(subst -, ,$(core)))))

.PHONY: rtl-raster rtl-raster-all
rtl-raster: $(RASTER_CORES:%=$(BUILD)/rtl/raster-%/bench) ## raster and shade against the model, with random stalls
	$(Q)for bench in $^; do $$bench || exit 1; done

rtl-raster-all: $(RASTER_ALL_CORES:%=$(BUILD)/rtl/raster-%/bench) ## the same for every core that is built, and longer
	$(Q)for bench in $^; do $$bench 1000 || exit 1; done

CHECKS += rtl-raster
