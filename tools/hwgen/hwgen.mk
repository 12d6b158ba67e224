# SPDX-License-Identifier: MIT
# hwgen and what it makes.
##@ The interface

HWGEN := $(BUILD)/hwgen
HWGEN_OBJECTS := $(patsubst %.c,$(BUILD)/%.o,$(sort $(wildcard tools/hwgen/*.c)))

$(HWGEN): private LIBS := -lexpat
$(HWGEN): $(HWGEN_OBJECTS) $(OUTPUT_OBJECT)
	$(link)

.PHONY: generate check-generated
generate: $(HWGEN) ## rewrite what is made from rtl/gloss.xml
	$(Q)$(HWGEN) --c libaccel/gloss_packets.h --regs driver/gloss_regs.h \
		--sv rtl/gloss_hw.svh --table tools/decode/gloss_table.h --manual rtl/INTERFACE.md rtl/gloss.xml

check-generated: $(HWGEN) ## fail if a generated file differs from rtl/gloss.xml
	$(call quiet,CHECK,rtl/gloss.xml)
	$(Q)xmllint --noout --dtdvalid rtl/gloss.dtd rtl/gloss.xml
	$(Q)mkdir -p $(BUILD)/generated
	$(Q)$(HWGEN) --c $(BUILD)/generated/gloss_packets.h \
		--regs $(BUILD)/generated/gloss_regs.h --sv $(BUILD)/generated/gloss_hw.svh \
		--table $(BUILD)/generated/gloss_table.h \
		--manual $(BUILD)/generated/INTERFACE.md rtl/gloss.xml
	$(Q)for file in libaccel/gloss_packets.h driver/gloss_regs.h rtl/gloss_hw.svh \
			tools/decode/gloss_table.h rtl/INTERFACE.md; do \
		diff -u "$$file" "$(BUILD)/generated/$${file##*/}" && continue; \
		echo "$$file is not what rtl/gloss.xml says: run 'make generate' and commit it" >&2; \
		exit 1; \
	done
