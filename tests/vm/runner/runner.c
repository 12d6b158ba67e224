// SPDX-License-Identifier: MIT
#include "runner.h"

#include <errno.h>
#include <grp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/io.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/reboot.h>
#include <sys/wait.h>
#include <unistd.h>

#define EXIT_PORT 0xf4 /* QEMU's isa-debug-exit */
#define EXIT_SKIP 77
#define RENDER_GROUP 105 /* where the host has no group "render" */
#define FAULT_TIMEOUT "timeout_ms=500"
/* The boards are programs: on a busy machine a job of theirs may take long. */
#define JOB_LIMIT "job_limit_ms=120000"
#define STEP_SECONDS 300
#define NODE_MS 60000

static struct plan plan;
static struct board boards[BOARDS];
static unsigned int render = RENDER_GROUP;
static int log_fd, board_fd, passed, failed, skipped;

void runner_end(bool end_failed)
{
	fflush(stdout);
	if (!ioperm(EXIT_PORT, 1, 1))
		outb(end_failed, EXIT_PORT);
	reboot(RB_POWER_OFF);
	exit(1);
}

void runner_die(const char *format, ...)
{
	va_list args;

	va_start(args, format);
	printf("runner: ");
	vprintf(format, args);
	printf("\n");
	va_end(args);
	runner_end(true);
}

/* ---- telling ---- */

static void print_lines(const char *before, const char *text)
{
	while (text && *text) {
		int length = (int)strcspn(text, "\n");

		printf("%s%.*s\n", before, length, text);
		text += length + (text[length] == '\n');
	}
}

static void print_file(const char *path)
{
	FILE *file = fopen(path, "r");
	char line[1024];

	while (file && fgets(line, sizeof(line), file)) {
		line[strcspn(line, "\n")] = '\0';
		printf("  | %s\n", line);
	}
	if (file)
		fclose(file);
}

/* The last line that says why a program skipped. */
static void print_skip(const char *path)
{
	FILE *file = fopen(path, "r");
	char line[1024], reason[1024] = "no reason given";

	while (file && fgets(line, sizeof(line), file))
		if (!strncmp(line, "skip: ", 6)) {
			line[strcspn(line, "\n")] = '\0';
			strcpy(reason, line + 6);
		}
	if (file)
		fclose(file);
	printf(": %s\n", reason);
}

static void print_end(const struct program *program)
{
	if (program->late)
		printf(": killed after %d s\n", program->seconds);
	else if (WIFSIGNALED(program->status))
		printf(": %s\n", strsignal(WTERMSIG(program->status)));
	else if (WEXITSTATUS(program->status))
		printf(": exit status %d\n", WEXITSTATUS(program->status));
	else
		printf("\n");
}

/* One line for what was done, and all there is to read if it failed. @wrong: what is wrong though
 * the program says nothing, or NULL.
 */
static bool tell(const char *name, const struct program *program, const char *wrong)
{
	bool normal = !program->late && WIFEXITED(program->status);
	char *messages = log_take();
	bool ok = normal && !messages && !wrong;

	if (ok && WEXITSTATUS(program->status) == EXIT_SKIP) {
		skipped++;
		printf("skip  %s", name);
		print_skip(program->output);
		return true;
	}
	ok = ok && !WEXITSTATUS(program->status);
	printf("%s  %s (%.1f s)", ok ? "ok  " : "FAIL", name, program->took);
	print_end(program);
	if (!ok) {
		print_file(program->output);
		print_lines("  ! ", wrong);
		print_lines("  kernel: ", messages);
	}
	free(messages);
	fflush(stdout);
	passed += ok;
	failed += !ok;
	return ok;
}

/* ---- doing ---- */

static bool run_step(const char *name, char *const *argv, const char *(*check)(void))
{
	char output[512];
	struct program program = { .argv = argv,
				   .output = output,
				   .seconds = STEP_SECONDS * plan.slow };
	const char *wrong = NULL;

	snprintf(output, sizeof(output), "%s/%s.log", plan.out, name);
	program_run(&program, log_fd, board_fd);
	if (check && !program.late && WIFEXITED(program.status) && !WEXITSTATUS(program.status))
		wrong = check();
	return tell(name, &program, wrong);
}

static bool find_usb_boards(void)
{
	int left = NODE_MS * plan.slow;

	while (usb_own(render) < USB_BOARDS && left > 0) {
		usleep(10 * 1000);
		left -= 10;
	}
	return left > 0;
}

static const char *check_boards(void)
{
	const char *const nodes[] = { "GLOSS_NODE_RTL", "GLOSS_NODE_MODEL" };
	const char *const pci[] = { "GLOSS_PCI_RTL", "GLOSS_PCI_MODEL" };
	int found = board_find(boards, NODE_MS * plan.slow);

	for (int i = 0; found == BOARDS && i < BOARDS; i++) {
		setenv(nodes[i], boards[i].node, 1);
		setenv(pci[i], boards[i].pci, 1);
	}
	if (found < BOARDS)
		return "a board has no render node";
	return find_usb_boards() ? NULL : "a board on USB is not there";
}

static bool load(void)
{
	char module[512];
	char *modprobe[PLAN_MODULES + 5] = { "modprobe", "-a", "-d", plan.modules };
	char *insmod[] = { "insmod", module, FAULT_TIMEOUT, JOB_LIMIT, NULL };

	for (int i = 0; i < plan.modprobes; i++)
		modprobe[i + 4] = plan.modprobe[i];
	if (plan.modprobes && !run_step("modprobe", modprobe, NULL))
		return false;
	snprintf(module, sizeof(module), "%s/gloss.ko", plan.driver);
	return run_step("load", insmod, check_boards);
}

/* So that one test that fails does not take all others with it. */
static void bring_boards_back(void)
{
	FILE *file = fopen("/sys/bus/pci/rescan", "w");

	if (file) {
		fputs("1", file);
		fclose(file);
	}
	check_boards();
	free(log_take());
}

static void run_test(const struct plan_test *test)
{
	char path[512], output[512];
	char *argv[] = { path, NULL };
	struct program program = {
		.argv = argv,
		.output = output,
		.uid = test->root ? 0 : plan.user,
		.group = render,
		.seconds = test->seconds * plan.slow,
	};
	const char *wrong;

	snprintf(path, sizeof(path), "%s/tests/vm/%s", plan.build, test->name);
	snprintf(output, sizeof(output), "%s/%s.log", plan.out, test->name);
	setenv("GLOSS_TEST", test->name, 1);
	program_run(&program, log_fd, board_fd);
	wrong = check_boards();
	tell(test->name, &program, wrong);
	if (wrong)
		bring_boards_back();
}

static bool prepare_checkers(void)
{
	char *nothing[] = { "true", NULL };

	return !plan.debug || run_step("checkers-speak", nothing, debug_speak);
}

static void run_kunit(void)
{
	char module[512];
	char *insmod[] = { "insmod", module, NULL };
	char *rmmod[] = { "rmmod", "gloss_kunit", NULL };

	snprintf(module, sizeof(module), "%s/gloss_kunit.ko", plan.driver);
	log_keep();
	if (run_step("kunit", insmod, debug_kunit))
		run_step("kunit-unload", rmmod, NULL);
}

static void run_all(void)
{
	/* The last fences are freed some time after the last program has ended. */
	char *rmmod[] = { "sh", "-c", "until rmmod gloss; do sleep 0.1; done", NULL };
	char *nothing[] = { "true", NULL };

	for (int i = 0; i < plan.test_count; i++)
		run_test(&plan.tests[i]);
	if (plan.debug)
		run_kunit();
	run_step("unload", rmmod, NULL);
	if (plan.debug) {
		run_step("kmemleak", nothing, debug_leaks);
		run_step("checkers", nothing, debug_state);
	}
}

static void run_shell(void)
{
	char *argv[] = { "/bin/bash", "--norc", "-i", NULL };
	struct program shell = { .argv = argv };
	struct winsize size = {
		.ws_row = (unsigned short)atoi(plan.rows),
		.ws_col = (unsigned short)atoi(plan.columns),
	};

	ioctl(STDIN_FILENO, TIOCSWINSZ, &size);
	setenv("TERM", plan.term, 1);
	setenv("PS1", "gloss-vm# ", 1);
	printf("Boards: $GLOSS_NODE_RTL is %s, $GLOSS_NODE_MODEL is %s, and on USB there are\n"
	       "$GLOSS_USB_RTL and $GLOSS_USB_MODEL.\n"
	       "Tests: %s/tests/vm. The host's files: /host. exit ends the machine.\n",
	       boards[0].node, boards[1].node, plan.build);
	program_run(&shell, log_fd, board_fd);
}

static void set_up(void)
{
	struct group *group = getgrnam("render");

	if (group)
		render = group->gr_gid;
	setenv("PATH", "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", 1);
	setenv("HOME", "/tmp", 1);
	setenv("GLOSS_VM_OUT", plan.out, 1);
	setenv("GLOSS_SOURCE", plan.source, 1);
	setenv("GLOSS_BUILD", plan.build, 1);
	setenv("GLOSS_DRIVER", plan.driver, 1);
	setenv("GLOSS_SLOW", plan.slow_text, 1);
	setenv("GLOSS_USB_RTL", "usb:1209:0001/RTL0", 1);
	setenv("GLOSS_USB_MODEL", "usb:1209:0001/MODEL0", 1);
	if (plan.seed)
		setenv("GLOSS_SEED", plan.seed, 1);
	if (plan.points)
		setenv("GLOSS_POINTS", plan.points, 1);
	/* What a test leaves behind becomes a child of this process. */
	prctl(PR_SET_CHILD_SUBREAPER, 1);
	log_fd = log_open();
	board_fd = board_open(render);
}

int main(int argc, char **argv)
{
	if (argc != 2)
		runner_die("usage: runner PLAN");
	plan_read(&plan, argv[1]);
	set_up();
	printf("vm: up\n");
	fflush(stdout);
	if (plan.interactive) {
		load();
		run_shell();
		runner_end(false);
	}
	if (prepare_checkers() && load())
		run_all();
	printf("vm: %d passed, %d failed, %d skipped\n", passed, failed, skipped);
	runner_end(failed);
}
