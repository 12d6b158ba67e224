# SPDX-License-Identifier: MIT
# gloss-info, its tests, and the udev rule that lets users have USB boards.

INFO_PARTS := $(addprefix $(BUILD)/tools/info/, list.o print.o json.o)
INFO_OBJECTS := $(BUILD)/tools/info/main.o $(INFO_PARTS)

$(INFO_OBJECTS): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Itools $(CFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/tools/info/main.o: ACCEL_CFLAGS += -DGLOSS_RELEASE='"$(ACCEL_VERSION)"'

$(BUILD)/gloss-info: $(INFO_OBJECTS) $(DEVICE_OBJECT) $(BUILD)/libaccel.a
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ $(ACCEL_LIBS) -o $@

-include $(INFO_OBJECTS:.o=.d)

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

include tests/info/info.mk
