# SPDX-License-Identifier: MIT
# gloss-decode.

DECODE_OBJECTS := $(BUILD)/tools/decode/decode.o $(BUILD)/tools/decode/print.o

$(BUILD)/gloss-decode: $(BUILD)/tools/decode/main.o $(DECODE_OBJECTS)
	$(link)

ALL += $(BUILD)/gloss-decode

.PHONY: install-decode
install-decode: $(BUILD)/gloss-decode
	$(call quiet,INSTALL,gloss-decode)
	$(Q)install -D -m 755 $(BUILD)/gloss-decode $(DESTDIR)$(PREFIX)/bin/gloss-decode
	$(Q)install -D -m 644 tools/decode/gloss-decode.1 $(DESTDIR)$(PREFIX)/share/man/man1/gloss-decode.1

INSTALLS += install-decode
