# SPDX-License-Identifier: MIT
# gloss-view.

VIEW_MAIN := $(BUILD)/tools/view/main.o
VIEW_OBJS := $(filter-out $(VIEW_MAIN),$(patsubst %.c,$(BUILD)/%.o,$(sort $(wildcard tools/view/*.c))))
VIEW_LIBS := $(SCENE_LIBS) $(shell pkg-config --libs sdl2 2>/dev/null)

FLAGS_tools/view := $(SCENE_CFLAGS)
FLAGS_tools/view/options.c := -DGLOSS_RELEASE='"$(ACCEL_VERSION)"'
$(BUILD)/tools/view/options.o: VERSION

# The library is linked in, so that build/gloss-view runs where it stands.
$(BUILD)/gloss-view: private LIBS := $(VIEW_LIBS)
$(BUILD)/gloss-view: $(VIEW_MAIN) $(VIEW_OBJS) $(SCENE_OBJS) $(BUILD)/libaccel.a
	$(link)

.PHONY: install-view
install-view: $(BUILD)/gloss-view
	$(call quiet,INSTALL,gloss-view)
	$(Q)install -D -m 755 $(BUILD)/gloss-view $(DESTDIR)$(PREFIX)/bin/gloss-view
	$(Q)install -D -m 644 tools/view/gloss-view.1 $(DESTDIR)$(PREFIX)/share/man/man1/gloss-view.1
	$(Q)install -D -m 644 tools/view/gloss-view.bash \
		$(DESTDIR)$(PREFIX)/share/bash-completion/completions/gloss-view

INSTALLS += install-view
ALL += $(BUILD)/gloss-view
