# SPDX-License-Identifier: MIT
# gloss-info, and the udev rule that lets users have USB boards.

INFO_OBJECTS := $(patsubst %.c,$(BUILD)/%.o,$(sort $(wildcard tools/info/*.c)))

FLAGS_tools/info/main.c := -DGLOSS_RELEASE='"$(ACCEL_VERSION)"'
$(BUILD)/tools/info/main.o: VERSION

$(BUILD)/gloss-info: private LIBS := $(ACCEL_LIBS)
$(BUILD)/gloss-info: $(INFO_OBJECTS) $(DEVICE_OBJECT) $(BUILD)/libaccel.a
	$(link)

.PHONY: install-info install-udev
install-info: $(BUILD)/gloss-info
	$(call quiet,INSTALL,gloss-info)
	$(Q)install -D -m 755 $(BUILD)/gloss-info $(DESTDIR)$(PREFIX)/bin/gloss-info
	$(Q)install -D -m 644 tools/info/gloss-info.1 $(DESTDIR)$(PREFIX)/share/man/man1/gloss-info.1

# udev reads PREFIX/lib/udev/rules.d of /usr and /usr/local.
install-udev: tools/udev/60-gloss.rules
	$(call quiet,INSTALL,60-gloss.rules)
	$(Q)install -D -m 644 $< $(DESTDIR)$(PREFIX)/lib/udev/rules.d/60-gloss.rules

INSTALLS += install-info install-udev
ALL += $(BUILD)/gloss-info
