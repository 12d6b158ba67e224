/* SPDX-License-Identifier: MIT */
/*
 * How commands begin. Those that lists record are defined with GLOSS_LISTED<n>, where <n> is the
 * number of arguments; between the braces they have @context, and are what is done when the command
 * is executed, at once or by a list:
 *
 *	GLOSS_LISTED1(FrontFace, GLenum, mode)
 *	{
 *		...
 *	}
 */
#ifndef GLOSS_COMMAND_H
#define GLOSS_COMMAND_H

#include <stddef.h>

#include "api/commands.h"
#include "draw/list.h"
#include "state/context.h"
#include "state/error.h"

/* What several numbers are for a list: a struct, which is copied. */
struct gloss_vector {
	GLfloat v[4];
};

/* The context of a command that no list records and that is an error between glBegin and glEnd.
 * NULL: then it has no effect. What a list that is executed while it is compiled has done so far is
 * true. */
struct gloss_context *gloss_outside(void);
/* The same of a command that has its place in the order of drawing: what was collected before is
 * drawn. */
struct gloss_context *gloss_outside_ordered(void);

/* Before state that drawing depends on changes: draws what was collected with the old. */
void gloss_change(struct gloss_context *context, unsigned int dirty);
/* The same for a member of @size bytes that becomes @value, and nothing if it is that already. */
void gloss_assign(struct gloss_context *context, unsigned int dirty, void *member,
		  const void *value, size_t size);

#define GLOSS_LISTED0(name)                                                         \
	static void do_##name(struct gloss_context *context);                       \
	static void play_##name(struct gloss_context *context, const void *data)    \
	{                                                                           \
		(void)data;                                                         \
		do_##name(context);                                                 \
	}                                                                           \
	void gl_##name(void);                                                       \
	void gl_##name(void)                                                        \
	{                                                                           \
		struct gloss_context *context = gloss_listed(play_##name, NULL, 0); \
                                                                                    \
		if (context)                                                        \
			do_##name(context);                                         \
	}                                                                           \
	static void do_##name(struct gloss_context *context)

#define GLOSS_LISTED1_BY(record, name, A, a)                                              \
	struct call_##name {                                                              \
		A a;                                                                      \
	};                                                                                \
	static void do_##name(struct gloss_context *context, A a);                        \
	static void play_##name(struct gloss_context *context, const void *data)          \
	{                                                                                 \
		const struct call_##name *call = data;                                    \
                                                                                          \
		do_##name(context, call->a);                                              \
	}                                                                                 \
	void gl_##name(A a);                                                              \
	void gl_##name(A a)                                                               \
	{                                                                                 \
		const struct call_##name call = { a };                                    \
		struct gloss_context *context = record(play_##name, &call, sizeof(call)); \
                                                                                          \
		if (context)                                                              \
			play_##name(context, &call);                                      \
	}                                                                                 \
	static void do_##name(struct gloss_context *context, A a)
#define GLOSS_LISTED1(name, A, a) GLOSS_LISTED1_BY(gloss_listed, name, A, a)
/* The same of a command that is allowed between glBegin and glEnd. */
#define GLOSS_LISTED_INSIDE1(name, A, a) GLOSS_LISTED1_BY(gloss_listed_inside, name, A, a)

#define GLOSS_LISTED2(name, A, a, B, b)                                                         \
	struct call_##name {                                                                    \
		A a;                                                                            \
		B b;                                                                            \
	};                                                                                      \
	static void do_##name(struct gloss_context *context, A a, B b);                         \
	static void play_##name(struct gloss_context *context, const void *data)                \
	{                                                                                       \
		const struct call_##name *call = data;                                          \
                                                                                                \
		do_##name(context, call->a, call->b);                                           \
	}                                                                                       \
	void gl_##name(A a, B b);                                                               \
	void gl_##name(A a, B b)                                                                \
	{                                                                                       \
		const struct call_##name call = { a, b };                                       \
		struct gloss_context *context = gloss_listed(play_##name, &call, sizeof(call)); \
                                                                                                \
		if (context)                                                                    \
			play_##name(context, &call);                                            \
	}                                                                                       \
	static void do_##name(struct gloss_context *context, A a, B b)

#define GLOSS_LISTED3_BY(record, name, A, a, B, b, C, c)                                  \
	struct call_##name {                                                              \
		A a;                                                                      \
		B b;                                                                      \
		C c;                                                                      \
	};                                                                                \
	static void do_##name(struct gloss_context *context, A a, B b, C c);              \
	static void play_##name(struct gloss_context *context, const void *data)          \
	{                                                                                 \
		const struct call_##name *call = data;                                    \
                                                                                          \
		do_##name(context, call->a, call->b, call->c);                            \
	}                                                                                 \
	void gl_##name(A a, B b, C c);                                                    \
	void gl_##name(A a, B b, C c)                                                     \
	{                                                                                 \
		const struct call_##name call = { a, b, c };                              \
		struct gloss_context *context = record(play_##name, &call, sizeof(call)); \
                                                                                          \
		if (context)                                                              \
			play_##name(context, &call);                                      \
	}                                                                                 \
	static void do_##name(struct gloss_context *context, A a, B b, C c)
#define GLOSS_LISTED3(name, A, a, B, b, C, c) GLOSS_LISTED3_BY(gloss_listed, name, A, a, B, b, C, c)
/* The same of a command that is allowed between glBegin and glEnd. */
#define GLOSS_LISTED_INSIDE3(name, A, a, B, b, C, c) \
	GLOSS_LISTED3_BY(gloss_listed_inside, name, A, a, B, b, C, c)

#define GLOSS_LISTED4(name, A, a, B, b, C, c, D, d)                                             \
	struct call_##name {                                                                    \
		A a;                                                                            \
		B b;                                                                            \
		C c;                                                                            \
		D d;                                                                            \
	};                                                                                      \
	static void do_##name(struct gloss_context *context, A a, B b, C c, D d);               \
	static void play_##name(struct gloss_context *context, const void *data)                \
	{                                                                                       \
		const struct call_##name *call = data;                                          \
                                                                                                \
		do_##name(context, call->a, call->b, call->c, call->d);                         \
	}                                                                                       \
	void gl_##name(A a, B b, C c, D d);                                                     \
	void gl_##name(A a, B b, C c, D d)                                                      \
	{                                                                                       \
		const struct call_##name call = { a, b, c, d };                                 \
		struct gloss_context *context = gloss_listed(play_##name, &call, sizeof(call)); \
                                                                                                \
		if (context)                                                                    \
			play_##name(context, &call);                                            \
	}                                                                                       \
	static void do_##name(struct gloss_context *context, A a, B b, C c, D d)

#define GLOSS_LISTED5(name, A, a, B, b, C, c, D, d, E, e)                                       \
	struct call_##name {                                                                    \
		A a;                                                                            \
		B b;                                                                            \
		C c;                                                                            \
		D d;                                                                            \
		E e;                                                                            \
	};                                                                                      \
	static void do_##name(struct gloss_context *context, A a, B b, C c, D d, E e);          \
	static void play_##name(struct gloss_context *context, const void *data)                \
	{                                                                                       \
		const struct call_##name *call = data;                                          \
                                                                                                \
		do_##name(context, call->a, call->b, call->c, call->d, call->e);                \
	}                                                                                       \
	void gl_##name(A a, B b, C c, D d, E e);                                                \
	void gl_##name(A a, B b, C c, D d, E e)                                                 \
	{                                                                                       \
		const struct call_##name call = { a, b, c, d, e };                              \
		struct gloss_context *context = gloss_listed(play_##name, &call, sizeof(call)); \
                                                                                                \
		if (context)                                                                    \
			play_##name(context, &call);                                            \
	}                                                                                       \
	static void do_##name(struct gloss_context *context, A a, B b, C c, D d, E e)

#define GLOSS_LISTED6(name, A, a, B, b, C, c, D, d, E, e, F, f)                                 \
	struct call_##name {                                                                    \
		A a;                                                                            \
		B b;                                                                            \
		C c;                                                                            \
		D d;                                                                            \
		E e;                                                                            \
		F f;                                                                            \
	};                                                                                      \
	static void do_##name(struct gloss_context *context, A a, B b, C c, D d, E e, F f);     \
	static void play_##name(struct gloss_context *context, const void *data)                \
	{                                                                                       \
		const struct call_##name *call = data;                                          \
                                                                                                \
		do_##name(context, call->a, call->b, call->c, call->d, call->e, call->f);       \
	}                                                                                       \
	void gl_##name(A a, B b, C c, D d, E e, F f);                                           \
	void gl_##name(A a, B b, C c, D d, E e, F f)                                            \
	{                                                                                       \
		const struct call_##name call = { a, b, c, d, e, f };                           \
		struct gloss_context *context = gloss_listed(play_##name, &call, sizeof(call)); \
                                                                                                \
		if (context)                                                                    \
			play_##name(context, &call);                                            \
	}                                                                                       \
	static void do_##name(struct gloss_context *context, A a, B b, C c, D d, E e, F f)

#endif
