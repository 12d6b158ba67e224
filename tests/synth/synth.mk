# SPDX-License-Identifier: MIT
# Size and clock of the hardware, with open tools. All of it takes long, and none is among the checks
# but the tests of the programs.
##@ Pictures and figures

.PHONY: synth synth-stage pnr run-pnr
synth: ## size and clock on three FPGA families (half an hour of processor time); build/synth.json
	$(Q)tests/synth/synth.py $(BUILD) $(JOBS)

STAGE ?= command
synth-stage: ## clock of one stage: STAGE=command, raster_shade, fragment, tile, memory, port_usb
	$(Q)tests/synth/synth.py $(BUILD) $(JOBS) $(STAGE)

# PNR_CORE: k1, k8 or pci, else all; PNR_ACCEPT=1 writes tests/synth/pnr.json.
pnr: ## the whole core and the PCI port placed and routed on ECP5 (an hour of processor time); build/pnr.json
	$(Q)tests/synth/pnr.py $(if $(PNR_ACCEPT),--accept) $(BUILD) $(or $(GLOSS_CACHE),$(BUILD)) $(JOBS) $(PNR_CORE)

run-pnr:
	$(call quiet,TEST,pnr)
	$(Q)tests/synth/test_pnr.py $(BUILD)

UNIT_TESTS += pnr
