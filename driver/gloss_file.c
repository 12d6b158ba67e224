// SPDX-License-Identifier: GPL-2.0-only
/*
 * An open file: an entity of the scheduler for each priority, and what is counted of the
 * file's jobs.
 */
#include <drm/drm_file.h>
#include <linux/sched.h>
#include <linux/slab.h>

#include "gloss_drv.h"
#include "gloss_file.h"

static const enum drm_sched_priority gloss_file_priority[GLOSS_PRIORITIES] = {
	[DRM_GLOSS_PRIORITY_NORMAL] = DRM_SCHED_PRIORITY_NORMAL,
	[DRM_GLOSS_PRIORITY_LOW] = GLOSS_SCHED_PRIORITY_LOW,
	[DRM_GLOSS_PRIORITY_HIGH] = DRM_SCHED_PRIORITY_HIGH,
};

static int gloss_file_init_entities(struct gloss_file *gfile)
{
	struct drm_gpu_scheduler *sched = &gfile->gdev->sched;
	unsigned int i;
	int ret;

	for (i = 0; i < GLOSS_PRIORITIES; i++) {
		ret = drm_sched_entity_init(&gfile->entity[i], gloss_file_priority[i], &sched, 1,
					    NULL);
		if (ret)
			goto destroy;
	}
	return 0;

destroy:
	while (i--)
		drm_sched_entity_destroy(&gfile->entity[i]);
	return ret;
}

int gloss_file_open(struct drm_device *drm, struct drm_file *file)
{
	struct gloss_device *gdev = to_gloss_device(drm);
	struct gloss_file *gfile;
	int ret;

	if (gloss_device_gone(gdev))
		return -ENODEV;

	gfile = kzalloc(sizeof(*gfile), GFP_KERNEL);
	if (!gfile)
		return -ENOMEM;

	kref_init(&gfile->ref);
	mutex_init(&gfile->lock);
	gfile->gdev = gdev;
	gfile->pid = task_tgid_nr(current);
	ret = gloss_file_init_entities(gfile);
	if (ret) {
		kfree(gfile);
		return ret;
	}
	file->driver_priv = gfile;
	return 0;
}

static void gloss_file_release(struct kref *ref)
{
	struct gloss_file *gfile = container_of(ref, struct gloss_file, ref);

	mutex_destroy(&gfile->lock);
	kfree(gfile);
}

void gloss_file_put(struct gloss_file *gfile)
{
	kref_put(&gfile->ref, gloss_file_release);
}

/*
 * Jobs that have not begun are cancelled; waits until none is queued. What the board has may
 * run on for GLOSS_CLOSED_LIMIT_MS.
 */
void gloss_file_close(struct drm_device *drm, struct drm_file *file)
{
	struct gloss_file *gfile = to_gloss_file(file);
	unsigned int i;

	WRITE_ONCE(gfile->closed, true);
	gloss_turns_close(&gfile->gdev->turns, gfile);
	gloss_sched_kick(gfile->gdev);
	for (i = 0; i < GLOSS_PRIORITIES; i++)
		drm_sched_entity_destroy(&gfile->entity[i]);
	gloss_file_put(gfile);
}

/* All open files: what they had in board memory is no more. */
void gloss_files_lost(struct gloss_device *gdev)
{
	struct drm_device *drm = &gdev->drm;
	struct drm_file *file;

	mutex_lock(&drm->filelist_mutex);
	list_for_each_entry(file, &drm->filelist, lhead)
		atomic_inc(&to_gloss_file(file)->jobs_lost);
	mutex_unlock(&drm->filelist_mutex);
}
