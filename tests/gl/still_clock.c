// SPDX-License-Identifier: MIT
/* For LD_PRELOAD: time stands still for programs that ask gettimeofday, so that glxgears stays at its first
 * angle and its pictures can be compared. */
#include <sys/time.h>

int gettimeofday(struct timeval *time, void *zone)
{
	(void)zone;
	time->tv_sec = 1000000000;
	time->tv_usec = 0;
	return 0;
}
