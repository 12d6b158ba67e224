/* SPDX-License-Identifier: MIT */
/*
 * Stands in for the core behind a port: keeps what it is given of each job, answers what it was told
 * to, as the stream comes in, and does not take the stream while an answer waits. It obeys its reset.
 */
#ifndef TESTS_PORT_CORE_H
#define TESTS_PORT_CORE_H

#include <algorithm>
#include <deque>
#include <vector>

#include "tb.h"

struct PortSlot {
	uint32_t base, size, rights;

	bool operator==(const PortSlot &other) const
	{
		return base == other.base && size == other.size && rights == other.rights;
	}
};

/* What the core makes of a job. */
struct PortAnswer {
	std::vector<uint32_t> words;
	uint32_t cause = 0, offset = 0;
	uint32_t time[6] = {}; /* in the order of time_counters_t, from its low end */
};

/* What the port gave of it. */
struct PortSeen {
	uint32_t stream_words, response_words;
	std::vector<uint32_t> stream;
	std::vector<PortSlot> slots;
};

template <class Top> class PortCore
{
      public:
	explicit PortCore(Random &random) : random(random), slots(16)
	{
	}

	void drive(Top &top)
	{
		top.job_ready_i = !running && !hold(job_stall);
		top.stream_ready_i = running && !hung && taken < now.stream_words &&
				     !response_due() && !hold(stream_stall);
		response_offered = response_offered || (response_due() && !hold(response_stall));
		top.response_valid_i = response_offered;
		if (response_offered && response_count == 0)
			drive_response(top);
		top.response_count_i = response_count;
		bool fresh = !status_offered;
		status_offered = status_offered || (finished() && !hold(status_stall));
		top.status_valid_i = status_offered;
		tb_set(top.status_i, 0, 4, answer.cause);
		tb_set(top.status_i, 32, 32, answer.offset);
		tb_set(top.status_i, 64, 32, answered);
		/* The clock in which it comes is counted, too. */
		for (int n = 0; n < 6; n++)
			tb_set(top.time_i, 32 * n, 32, answer.time[n] - (n == 0 && fresh));
	}

	void sample(Top &top)
	{
		if (!top.core_rst_no) {
			reset();
			return;
		}
		if (top.slot_write_o)
			sample_slot(top);
		if (top.stream_valid_o && top.stream_ready_i)
			sample_stream(top);
		if (response_offered && top.response_ready_o) {
			answered += response_count;
			response_count = 0;
			response_offered = false;
		}
		if (status_offered && top.status_ready_o) {
			seen.push_back(now);
			status_offered = running = false;
		}
		if (top.job_valid_o && top.job_ready_i)
			sample_job(top);
	}

	bool stalls = false, hung = false; /* hung: takes no more of the stream */
	bool running = false;
	std::deque<PortAnswer> answers; /* of the jobs to come */
	std::deque<PortSeen> seen;      /* jobs that have ended */
	uint64_t jobs = 0;

      private:
	bool hold(Stall &stall)
	{
		return stalls && stall.now();
	}

	/* Answers come in proportion to what was taken. */
	bool response_due() const
	{
		uint64_t words = answer.words.size();

		return running && answered < words &&
		       (taken >= now.stream_words || answered * now.stream_words < words * taken);
	}

	bool finished() const
	{
		return running && !hung && taken >= now.stream_words &&
		       answered == answer.words.size();
	}

	void drive_response(Top &top)
	{
		uint32_t most = std::min<size_t>(LANES, answer.words.size() - answered);

		response_count = stalls && random.chance(20) ? random.between(1, most) : most;
		for (uint32_t n = 0; n < LANES; n++)
			tb_set(top.response_data_i, 32 * n, 32,
			       n < response_count ? answer.words[answered + n] : random.bits());
	}

	void sample_slot(const Top &top)
	{
		TB_CHECK(!running && !top.job_valid_o,
			 "a slot is written while a job starts or runs");
		slots[top.slot_index_o] = { top.slot_base_o, top.slot_size_o, top.slot_rights_o };
	}

	void sample_stream(const Top &top)
	{
		for (uint32_t n = 0; n < STREAM / 32 && taken < now.stream_words; n++, taken++)
			if (now.stream.size() < kept_most)
				now.stream.push_back(tb_get(top.stream_data_o, 32 * n, 32));
	}

	void sample_job(const Top &top)
	{
		running = true;
		jobs++;
		now = { top.job_stream_words_o, top.job_response_words_o, {}, slots };
		taken = answered = 0;
		answer = {};
		if (!answers.empty()) {
			answer = answers.front();
			answers.pop_front();
		}
	}

	void reset()
	{
		running = response_offered = status_offered = false;
		response_count = 0;
		answers.clear();
		seen.clear();
	}

	static const size_t kept_most = 100000;

	Random &random;
	std::vector<PortSlot> slots;
	PortSeen now = {};
	PortAnswer answer;
	uint64_t taken = 0, answered = 0;
	uint32_t response_count = 0;
	bool response_offered = false, status_offered = false;
	Stall job_stall{ random }, stream_stall{ random }, response_stall{ random },
		status_stall{ random };
};

#endif
