/* SPDX-License-Identifier: MIT */
/*
 * port_usb between a bridge and a stand-in for the core. What is sent says what has to come: each
 * word of IN is checked when it is taken, each job when its usb_completion is.
 */
#ifndef TESTS_PORT_USB_BENCH_H
#define TESTS_PORT_USB_BENCH_H

#include "Vport_usb.h"
#include "gloss_packets.h"
#include "gloss_regs.h"
#include "port_access.h"
#include "port_core.h"
#include "transport/usb/checksum.h"

struct UsbJob {
	uint32_t sequence, room;
	std::vector<uint32_t> stream;
	std::vector<PortSlot> slots; /* those that are sent */
	PortAnswer answer;
};

struct UsbWord {
	uint32_t word;
	bool flush, completes; /* a burst; a job */
};

class UsbBench : public PortAccess<Vport_usb>
{
      public:
	explicit UsbBench(uint64_t seed) : PortAccess(seed), core(random)
	{
		top.out_valid_i = top.in_ready_i = top.event_ready_i = 0;
		kind();
	}

	/* Nothing stalls. */
	void kind()
	{
		stalls = core.stalls = false;
	}
	void unkind()
	{
		stalls = core.stalls = true;
	}

	void random_stalls()
	{
		if (random.chance(80))
			unkind();
		else
			kind();
	}

	/* Resets the port, as a driver does, and forgets all jobs. Returns how long that took. */
	uint64_t reset_port()
	{
		uint64_t start = clocks;

		write(GLOSS_REG_CONTROL, GLOSS_REG_CONTROL_RESET | random.below(2));
		while (read(GLOSS_REG_CONTROL))
			TB_CHECK(clocks - start < 2000, "the reset does not end");
		core.answers.clear();
		core.hung = false;
		jobs.clear();
		expected.clear();
		events.clear();
		in_closed = events_closed = false;
		progress = finished = 0;
		for (uint64_t &sum : time)
			sum = 0;
		return clocks - start;
	}

	/* A new session, with whatever is still to be sent before it. */
	void start()
	{
		reset_port();
		do
			nonce = random.bits();
		while (!nonce);
		write(GLOSS_REG_NONCE, nonce);
		send_sync(nonce);
		expect_echo();
	}

	void send_sync(uint32_t nonce)
	{
		out.insert(out.end(),
			   { GLOSS_USB_SYNC_MAGIC, nonce, ~nonce, ~GLOSS_USB_SYNC_MAGIC });
	}

	void expect_echo()
	{
		expect(GLOSS_USB_SYNC_MAGIC);
		expect(nonce);
		expect(~nonce);
		expect(~GLOSS_USB_SYNC_MAGIC, true);
	}

	UsbJob job(uint32_t stream_words, uint32_t answer_words)
	{
		UsbJob job = {};

		job.sequence = random.bits();
		job.room = answer_words + random.below(5000);
		for (uint32_t n = 0; n < stream_words; n++)
			job.stream.push_back(random.bits());
		for (uint32_t n = 0; n < answer_words; n++)
			job.answer.words.push_back(random.bits());
		job.answer.cause = random.chance(30) ? random.between(1, 7) : 0;
		job.answer.offset = random.bits();
		for (uint32_t &count : job.answer.time)
			count = random.bits();
		for (int n = random.between(0, GLOSS_SLOTS); n > 0; n--)
			job.slots.push_back({ random.bits(), random.bits(), random.below(4) });
		return job;
	}

	UsbJob random_job()
	{
		static const uint32_t around[] = { 0, 1, 8, 256, 512, 768 };

		auto words = [this] {
			if (random.chance(20))
				return random.below(3000);
			uint32_t middle = around[random.below(6)];
			return (uint32_t)std::max(0, random.between((int)middle - 5, middle + 5));
		};
		uint32_t stream_words = words();
		return job(stream_words, random.chance(60) ? words() : 0);
	}

	/* Words for OUT, and those that have to come for them. */
	void send(const UsbJob &job)
	{
		send_words(job);
		expect(job);
	}

	/* All words of @job on OUT. */
	std::vector<uint32_t> words_of(const UsbJob &job)
	{
		std::vector<uint32_t> words = { GLOSS_USB_JOB_MAGIC << 8 |
							(uint32_t)job.slots.size(),
						job.sequence, (uint32_t)job.stream.size(),
						job.room };

		for (const PortSlot &slot : job.slots)
			words.insert(words.end(),
				     { slot.base, slot.size, slot.rights | random.bits() << 2,
				       random.bits() });
		words.insert(words.end(), job.stream.begin(), job.stream.end());
		words.push_back(accel_usb_checksum(0, &words[2], words.size() - 2));
		return words;
	}

	void send_words(const UsbJob &job)
	{
		std::vector<uint32_t> words = words_of(job);

		out.insert(out.end(), words.begin(), words.end());
	}

	/* Instead of the words of @job others that are not right: the core has them, its answer ends nowhere. */
	void send_wrong(const UsbJob &job, const std::vector<uint32_t> &words)
	{
		size_t count = job.answer.words.size();

		out.insert(out.end(), words.begin(), words.end());
		expect_response(job, count - count % GLOSS_USB_CHUNK_WORDS);
		core.answers.push_back(job.answer);
	}

	void expect_response(const UsbJob &job, size_t count)
	{
		const std::vector<uint32_t> &words = job.answer.words;

		for (size_t n = 0; n < count; n++) {
			if (n % GLOSS_USB_CHUNK_WORDS == 0)
				expect(GLOSS_USB_RESPONSE_MAGIC << 16 |
				       (uint32_t)std::min<size_t>(words.size() - n,
								  GLOSS_USB_CHUNK_WORDS));
			expect(words[n]);
		}
	}

	void expect(const UsbJob &job)
	{
		const std::vector<uint32_t> &words = job.answer.words;
		const uint32_t completion[] = { GLOSS_USB_COMPLETION_MAGIC << 16 | job.answer.cause,
						job.sequence, job.answer.offset,
						(uint32_t)words.size() };
		uint32_t sum = accel_usb_checksum(0, words.data(), words.size());

		expect_response(job, words.size());
		for (uint32_t word : completion)
			expect(word);
		expect(accel_usb_checksum(sum, completion, 4), true, true);
		core.answers.push_back(job.answer);
		jobs.push_back(job);
	}

	/* What is not sent yet never is. */
	void drop_out()
	{
		out.clear();
		out_offered = false;
	}

	/* Until every word is sent, and has left the FIFO. */
	void drain()
	{
		uint64_t start = clocks;

		while (!out.empty()) {
			TB_CHECK(clocks - start < 300000, "%zu words of OUT are not taken",
				 out.size());
			clock();
		}
		clock(1100);
	}

	/* Until the channel is lost, and everything that was sent is dropped. */
	void wait_lost()
	{
		uint64_t start = clocks;

		wait();
		while (!(read(GLOSS_REG_STATUS) & GLOSS_REG_STATUS_LOST))
			TB_CHECK(clocks - start < 100000, "the channel is not lost");
		drain();
		TB_CHECK(read(GLOSS_REG_STATUS) == (GLOSS_REG_STATUS_IDLE | GLOSS_REG_STATUS_LOST),
			 "STATUS");
		TB_CHECK(events.size() == 1 &&
				 events[0] == (GLOSS_USB_EVENT_MAGIC << 16 | GLOSS_USB_EVENT_LOST),
			 "events");
	}

	/* Until every word that has to come has come. */
	void wait()
	{
		uint64_t start = clocks;

		while (!expected.empty()) {
			TB_CHECK(clocks - start < 300000, "%zu words do not come, %zu of %zu jobs",
				 expected.size(), jobs.size(), jobs.size() + finished);
			clock();
		}
	}

	/* What registers say when all is done. */
	void check_counters()
	{
		static const uint32_t offsets[] = { GLOSS_REG_STALL_STREAM, GLOSS_REG_STALL_RASTER,
						    GLOSS_REG_STALL_TILE, GLOSS_REG_STALL_MEMORY,
						    GLOSS_REG_STALL_RESPONSE };
		uint64_t sum;

		TB_CHECK(read(GLOSS_REG_JOBS) == finished, "JOBS");
		TB_CHECK(read(GLOSS_REG_PROGRESS) == progress, "PROGRESS");
		sum = read(GLOSS_REG_CLOCKS_LOW) | (uint64_t)read(GLOSS_REG_CLOCKS_HIGH) << 32;
		TB_CHECK(sum == time[0], "CLOCKS is %" PRIx64, sum);
		for (int n = 0; n < 5; n++)
			TB_CHECK(read(offsets[n]) == (uint32_t)time[1 + n], "stall counter %d", n);
		TB_CHECK(read(GLOSS_REG_STATUS) == GLOSS_REG_STATUS_IDLE,
			 "not idle when all is done");
	}

	/* A job, and all that can be seen of it. */
	void check_works()
	{
		send(random_job());
		wait();
		check_counters();
	}

	/*
	 * @jobs have ended: their faults, in their order, are the events; or, if not @all, some of
	 * them are.
	 */
	void check_events(const std::deque<UsbJob> &jobs, bool all) const
	{
		std::deque<uint64_t> left = events;

		for (const UsbJob &job : jobs) {
			uint64_t event = (uint64_t)job.sequence << 32 |
					 GLOSS_USB_EVENT_MAGIC << 16 | job.answer.cause;

			if (!job.answer.cause)
				continue;
			if (!left.empty() && left.front() == event)
				left.pop_front();
			else
				TB_CHECK(!all, "the fault of %08x is no event", job.sequence);
		}
		TB_CHECK(left.empty(), "an event too many: %016" PRIx64, left.front());
	}

	using PortAccess::clock;

	void clock() override
	{
		drive_out();
		drive_in();
		core.drive(top);
		drive_access();
		settle();
		check_rules();
		sample_access();
		core.sample(top);
		sample();
		tick();
	}

	PortCore<Vport_usb> core;
	std::deque<uint32_t> out;     /* to be sent */
	std::deque<UsbWord> expected; /* of IN */
	std::deque<UsbJob> jobs;      /* not ended */
	std::deque<uint64_t> events;  /* fetched */
	bool stalls = false, in_closed = false, events_closed = false;
	uint32_t nonce = 0;
	uint32_t progress = 0, finished = 0; /* as the registers must have it */
	uint64_t time[6] = {};
	uint64_t sent = 0, taken = 0; /* words of OUT and of IN */
	uint64_t taken_clock = 0;     /* of the last */

      private:
	bool hold(Stall &stall)
	{
		return stalls && stall.now();
	}

	void expect(uint32_t word, bool flush = false, bool completes = false)
	{
		expected.push_back({ word, flush, completes });
	}

	/* What is offered stays until it is taken. */
	void drive_out()
	{
		out_offered = out_offered || (!out.empty() && !hold(out_stall));
		top.out_valid_i = out_offered;
		top.out_data_i = out_offered ? out.front() : random.bits();
	}

	void drive_in()
	{
		top.in_ready_i = !in_closed && !hold(in_stall);
		top.event_ready_i = !events_closed && !hold(event_stall);
	}

	void check_rules()
	{
		if (top.memory_stop_o)
			TB_CHECK(!top.out_ready_o && !top.in_valid_o && !top.event_valid_o,
				 "a word may pass in a reset");
		else if (in_waits)
			TB_CHECK(top.in_valid_o && top.in_data_o == in_word &&
					 top.in_flush_o == in_flush,
				 "a word of IN changes before it is taken");
		if (event_waits && !top.memory_stop_o)
			TB_CHECK(top.event_valid_o && top.event_o == event, "an event changes");
		in_waits = top.in_valid_o && !top.in_ready_i;
		in_word = top.in_data_o;
		in_flush = top.in_flush_o;
		event_waits = top.event_valid_o && !top.event_ready_i;
		event = top.event_o;
	}

	void sample()
	{
		if (out_offered && top.out_ready_o) {
			out.pop_front();
			out_offered = false;
			sent++;
		}
		if (top.event_valid_o && top.event_ready_i)
			events.push_back(top.event_o);
		if (top.in_valid_o && top.in_ready_i)
			sample_in();
	}

	void sample_in()
	{
		TB_CHECK(!expected.empty(), "a word too many on IN: %08x", top.in_data_o);
		UsbWord word = expected.front();

		TB_CHECK(top.in_data_o == word.word && top.in_flush_o == word.flush,
			 "IN has %08x%s, not %08x%s", top.in_data_o, top.in_flush_o ? " flush" : "",
			 word.word, word.flush ? " flush" : "");
		expected.pop_front();
		taken++;
		taken_clock = clocks;
		if (word.completes)
			check(jobs.front());
	}

	void check(const UsbJob &job)
	{
		TB_CHECK(core.seen.size() == 1, "a usb_completion of nothing");
		const PortSeen &seen = core.seen.front();

		TB_CHECK(seen.stream_words == job.stream.size() &&
				 seen.response_words == job.room && seen.stream == job.stream,
			 "the stream is not the job's");
		for (size_t n = 0; n < GLOSS_SLOTS; n++) {
			PortSlot slot = n < job.slots.size() ? job.slots[n] : PortSlot{};

			slot.base &= ~4095u;
			TB_CHECK(seen.slots[n] == slot, "slot %zu is not the job's", n);
		}
		progress += job.stream.size() + job.answer.words.size();
		finished++;
		for (int n = 0; n < 6; n++)
			time[n] += TIME_COUNTERS * job.answer.time[n];
		core.seen.pop_front();
		jobs.pop_front();
	}

	bool out_offered = false;
	bool in_waits = false, in_flush = false, event_waits = false;
	uint32_t in_word = 0;
	uint64_t event = 0;
	Stall out_stall{ random }, in_stall{ random }, event_stall{ random };
};

/* tb_port_usb_faults.cpp */
void port_usb_faults(UsbBench &bench, int rounds);

#endif
