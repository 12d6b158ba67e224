/* SPDX-License-Identifier: MIT */
/* The commands of OpenGL by their names. */
#ifndef GLOSS_PROC_H
#define GLOSS_PROC_H

typedef void (*gloss_proc)(void);

struct gloss_proc_name {
	const char *name;
	gloss_proc proc; /* NULL: not implemented */
};

extern const struct gloss_proc_name gloss_proc_table[];
extern const unsigned int gloss_proc_count;

/* The function of the command @name, which may be an alias, such as glActiveTextureARB. NULL: there
 * is no such command, or it is not implemented. */
gloss_proc gloss_proc_find(const char *name);

/* The same in a table of @count rows in the order of strcmp(). */
gloss_proc gloss_proc_search(const struct gloss_proc_name *table, unsigned int count,
			     const char *name);

#endif
