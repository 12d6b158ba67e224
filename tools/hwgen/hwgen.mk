# SPDX-License-Identifier: MIT
# hwgen and what it makes, gloss-decode, and their tests; gloss-info is in info.mk.

HWGEN := $(BUILD)/hwgen
HWGEN_OBJECTS := $(patsubst %.c,$(BUILD)/%.o,$(sort $(wildcard tools/hwgen/*.c)))
# Files that appear whole or not at all; gloss-view writes its pictures with it too.
OUTPUT_OBJECT := $(BUILD)/tools/output.o
# Boards that open, or a line that says why not.
DEVICE_OBJECT := $(BUILD)/tools/device.o
DECODE_OBJECTS := $(BUILD)/tools/decode.o $(BUILD)/tools/decode_print.o

$(HWGEN_OBJECTS) $(OUTPUT_OBJECT) $(DEVICE_OBJECT) $(DECODE_OBJECTS) \
		$(BUILD)/tools/gloss-decode.o: $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Itools $(CFLAGS) -MMD -MP -c -o $@ $<

$(HWGEN): $(HWGEN_OBJECTS) $(OUTPUT_OBJECT)
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lexpat

$(BUILD)/gloss-decode: $(BUILD)/tools/gloss-decode.o $(DECODE_OBJECTS)
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^

-include $(HWGEN_OBJECTS:.o=.d) $(OUTPUT_OBJECT:.o=.d) $(DEVICE_OBJECT:.o=.d) \
	$(DECODE_OBJECTS:.o=.d) $(BUILD)/tools/gloss-decode.d

ALL += $(BUILD)/gloss-decode

.PHONY: generate check-generated
generate: $(HWGEN) ## rewrite what is made from rtl/gloss.xml
	$(Q)$(HWGEN) --c libaccel/gloss_packets.h --regs driver/gloss_regs.h \
		--sv rtl/gloss_hw.svh --table tools/gloss_table.h --manual rtl/INTERFACE.md rtl/gloss.xml

check-generated: $(HWGEN) ## fail if a generated file differs from rtl/gloss.xml
	$(call quiet,CHECK,rtl/gloss.xml)
	$(Q)xmllint --noout --dtdvalid rtl/gloss.dtd rtl/gloss.xml
	$(Q)mkdir -p $(BUILD)/generated
	$(Q)$(HWGEN) --c $(BUILD)/generated/gloss_packets.h \
		--regs $(BUILD)/generated/gloss_regs.h --sv $(BUILD)/generated/gloss_hw.svh \
		--table $(BUILD)/generated/gloss_table.h \
		--manual $(BUILD)/generated/INTERFACE.md rtl/gloss.xml
	$(Q)for file in libaccel/gloss_packets.h driver/gloss_regs.h rtl/gloss_hw.svh \
			tools/gloss_table.h rtl/INTERFACE.md; do \
		diff -u "$$file" "$(BUILD)/generated/$${file##*/}" && continue; \
		echo "$$file is not what rtl/gloss.xml says: run 'make generate' and commit it" >&2; \
		exit 1; \
	done

# The decoder is compared with the model, which is in parts.a of the library.
$(BUILD)/tests/unit/test_decode: tests/unit/test_decode.c $(DECODE_OBJECTS) \
		$(BUILD)/libaccel/parts.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -Itools -MMD -MP -MF $@.d $(filter-out %.h,$^) \
		-lcmocka -o $@

$(BUILD)/tests/hwgen/test_small: tests/hwgen/test_small.c tests/hwgen/small.h \
		tests/hwgen/small_regs.h
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) $< -lcmocka -o $@

.PHONY: run-decode run-hwgen refresh-hwgen install-decode
run-decode: $(BUILD)/tests/unit/test_decode $(BUILD)/gloss-decode
	$(call quiet,TEST,decode)
	$(Q)$(BUILD)/tests/unit/test_decode
	$(Q)tests/decode/run $(BUILD)/gloss-decode $(BUILD)

run-hwgen: $(BUILD)/tests/hwgen/test_small $(HWGEN)
	$(call quiet,TEST,hwgen)
	$(Q)$(BUILD)/tests/hwgen/test_small
	$(Q)tests/hwgen/run $(HWGEN) $(BUILD)

refresh-hwgen: $(HWGEN) ## make what hwgen does now the expected; read the diff
	$(Q)tests/hwgen/run $(HWGEN) $(BUILD) --refresh

UNIT_TESTS += decode hwgen

install-decode: $(BUILD)/gloss-decode
	$(Q)install -D -m 755 $(BUILD)/gloss-decode $(DESTDIR)$(PREFIX)/bin/gloss-decode
	$(Q)install -D -m 644 tools/gloss-decode.1 $(DESTDIR)$(PREFIX)/share/man/man1/gloss-decode.1

INSTALLS += install-decode
