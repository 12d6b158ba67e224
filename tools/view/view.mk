# SPDX-License-Identifier: MIT
# gloss-view.

VIEW_SOURCES := $(addprefix tools/view/, camera.c compare.c draw.c light.c material.c number.c options.c \
	progress.c stats.c turntable.c window.c)

VIEW_OBJS := $(VIEW_SOURCES:%.c=$(BUILD)/%.o)
VIEW_MAIN := $(BUILD)/tools/view/main.o

$(VIEW_OBJS) $(VIEW_MAIN): $(BUILD)/%.o: %.c
	$(call quiet,CC,$<)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) $(VIEW_CFLAGS) $(CFLAGS) -MMD -MP -c $< -o $@

# The library is linked in, so that build/gloss-view runs where it stands.
$(BUILD)/gloss-view: $(VIEW_MAIN) $(VIEW_OBJS) $(SCENE_OBJS) $(BUILD)/libaccel.a
	$(call quiet,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ $(SCENE_LIBS) $$(pkg-config --libs sdl2) -o $@

-include $(VIEW_OBJS:.o=.d) $(VIEW_MAIN:.o=.d)

$(BUILD)/tools/view/options.o: ACCEL_CFLAGS += -DGLOSS_RELEASE='"$(ACCEL_VERSION)"'

.PHONY: install-view
install-view: $(BUILD)/gloss-view
	$(call quiet,INSTALL,gloss-view)
	$(Q)install -D -m 755 $(BUILD)/gloss-view $(DESTDIR)$(PREFIX)/bin/gloss-view
	$(Q)install -D -m 644 tools/view/gloss-view.1 $(DESTDIR)$(PREFIX)/share/man/man1/gloss-view.1
	$(Q)install -D -m 644 tools/view/gloss-view.bash \
		$(DESTDIR)$(PREFIX)/share/bash-completion/completions/gloss-view

INSTALLS += install-view
LINT_C += $(VIEW_CFLAGS)
ALL += $(BUILD)/gloss-view

include tests/image/image.mk
include tests/bench/bench.mk
include tests/view/view.mk
