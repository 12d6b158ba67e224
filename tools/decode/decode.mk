# SPDX-License-Identifier: MIT
# gloss-decode and its tests.

DECODE_OBJECTS := $(BUILD)/tools/decode/decode.o $(BUILD)/tools/decode/print.o
DECODE_MAIN := $(BUILD)/tools/decode/main.o

$(DECODE_OBJECTS) $(DECODE_MAIN): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Itools $(CFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/gloss-decode: $(DECODE_MAIN) $(DECODE_OBJECTS)
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^

-include $(DECODE_OBJECTS:.o=.d) $(DECODE_MAIN:.o=.d)

ALL += $(BUILD)/gloss-decode

# The decoder is compared with the model, which is in parts.a of the library.
$(call unit,test_decode): tests/unit/tools/test_decode.c $(DECODE_OBJECTS) \
		$(BUILD)/libaccel/parts.a
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(CFLAGS) -Itools -MMD -MP -MF $@.d $(filter-out %.h,$^) \
		-lcmocka -o $@

.PHONY: run-decode install-decode
run-decode: $(call unit,test_decode) $(BUILD)/gloss-decode
	$(call quiet,TEST,decode)
	$(Q)$(call unit,test_decode)
	$(Q)tests/decode/run $(BUILD)/gloss-decode $(BUILD)

UNIT_TESTS += decode

install-decode: $(BUILD)/gloss-decode
	$(Q)install -D -m 755 $(BUILD)/gloss-decode $(DESTDIR)$(PREFIX)/bin/gloss-decode
	$(Q)install -D -m 644 tools/decode/gloss-decode.1 $(DESTDIR)$(PREFIX)/share/man/man1/gloss-decode.1

INSTALLS += install-decode
