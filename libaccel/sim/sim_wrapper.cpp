// SPDX-License-Identifier: MIT
/*
 * The plugin of sim.h: a Verilated gloss_core, a memory behind it, and a host
 * that feeds it. SIM_TILE, SIM_LANES and SIM_STREAM_BITS come from the build and
 * are the parameters the core was built with.
 */
#include <cerrno>
#include <cstring>
#include <new>

#include "Vgloss_core.h"
#include "sim/sim.h"
#include "sim/sim_memory.h"
#include "sim/sim_port.h"
#include "verilated.h"

struct gloss_sim {
public:
	gloss_sim(void *memory, uint64_t size) : memory_(memory, size) { reset(); }

	/* Scopes of a core leave the context of the thread, which is that of the core made last. */
	~gloss_sim() { Verilated::threadContextp(&context_); }

	void stalls(uint64_t seed) { stalls_ = SimStalls(seed); }
	const char *violation() const { return violation_; }

	int run(const accel_job &job, uint64_t limit, gloss_status &status)
	{
		job_ = &job;
		words_sent_ = words_received_ = 0;
		violation_ = "";
		stalls_.begin_job();
		write_slots();
		start();
		int err = finish(limit);
		rest();
		if (err) {
			reset();
			return err;
		}
		uint32_t words[] = { core_.status_o[0], core_.status_o[1], core_.status_o[2] };
		gloss_status_unpack(words, &status);
		return 0;
	}

	gloss_sim_clocks clocks() const
	{
		const auto &time = core_.time_o;
		return { time[0], time[1], time[2], time[3], time[4], time[5] };
	}

	void reset()
	{
		rest();
		core_.rst_ni = 0;
		for (unsigned i = 0; i < ResetClocks; i++)
			edge();
		core_.rst_ni = 1;
		memory_.reset();
		response_.reset();
		status_.reset();
		edge();
	}

private:
	static constexpr unsigned StreamWords = SIM_STREAM_BITS / 32;
	static constexpr unsigned ResetClocks = 4;

	/* Nothing is offered and nothing is taken. */
	void rest()
	{
		core_.job_valid_i = core_.slot_write_i = 0;
		core_.stream_valid_i = core_.response_ready_i = core_.status_ready_i = 0;
		core_.axi_awready_i = core_.axi_wready_i = core_.axi_bvalid_i = 0;
		core_.axi_arready_i = core_.axi_rvalid_i = 0;
		job_waits_ = stream_waits_ = false;
	}

	/* Inputs that were set since the last edge act at this one. */
	void edge()
	{
		core_.clk_i = 0;
		core_.eval();
		core_.clk_i = 1;
		core_.eval();
	}

	void write_slots()
	{
		core_.slot_write_i = 1;
		for (unsigned i = 0; i < GLOSS_SLOTS; i++) {
			core_.slot_index_i = i;
			core_.slot_base_i = job_->slot[i].base;
			core_.slot_size_i = job_->slot[i].size;
			core_.slot_rights_i = job_->slot[i].rights;
			edge();
		}
		core_.slot_write_i = 0;
	}

	void start()
	{
		core_.job_stream_words_i = job_->stream_words;
		core_.job_response_words_i = job_->response_words;
		job_waits_ = true;
		quiet_ = 0;
	}

	/* Clocks the core until it has given its status, or broken a rule. */
	int finish(uint64_t limit)
	{
		for (uint64_t clock = 0; clock < limit && quiet_ < GLOSS_SIM_QUIET; clock++) {
			drive();
			core_.clk_i = 0;
			core_.eval();
			bool ended = sample();
			core_.clk_i = 1;
			core_.eval();
			if (*violation_)
				return -EPROTO;
			if (ended)
				return 0;
		}
		return -ETIME;
	}

	/* Inputs of the coming edge; they do not change before it is over. */
	void drive()
	{
		memory_.drive(core_, stalls_);
		drive_stream();
		core_.job_valid_i = job_waits_;
		core_.response_ready_i = stalls_.pass(SimPort::Response);
		core_.status_ready_i = stalls_.pass(SimPort::Status);
	}

	void drive_stream()
	{
		if (!stream_waits_ && words_sent_ < job_->stream_words &&
		    stalls_.pass(SimPort::Stream)) {
			for (unsigned i = 0; i < StreamWords; i++) {
				uint64_t at = words_sent_ + i;
				sim_set(core_.stream_data_i, i,
					at < job_->stream_words ? job_->stream[at] : spare());
			}
			stream_waits_ = true;
		}
		core_.stream_valid_i = stream_waits_;
	}

	/* What is transferred at the coming edge; true for the status. */
	bool sample()
	{
		bool moved = memory_.sample(core_, stalls_, violation_);
		moved = sample_job() || moved;
		moved = sample_stream() || moved;
		moved = sample_response() || moved;
		quiet_ = moved ? 0 : quiet_ + 1;
		return sample_status();
	}

	bool sample_job()
	{
		if (!job_waits_ || !core_.job_ready_o)
			return false;
		job_waits_ = false;
		return true;
	}

	/* Nothing may depend on the words after a stream's last. */
	uint32_t spare() { return stalls_.on() ? stalls_.below(~0u) : 0; }

	bool sample_stream()
	{
		if (!stream_waits_ || !core_.stream_ready_o)
			return false;
		words_sent_ += StreamWords;
		stream_waits_ = false;
		return true;
	}

	bool sample_response()
	{
		uint32_t held[SIM_LANES + 1] = { core_.response_count_o };
		unsigned count = held[0];
		if (!core_.response_valid_o && !response_.waiting())
			return false;
		if (count < 1 || count > SIM_LANES) {
			violation_ = "a response beat of no words, or of too many";
			return false;
		}
		for (unsigned i = 0; i < count; i++)
			held[1 + i] = sim_get(core_.response_data_o, i);
		if (!response_.holds(core_.response_valid_o, core_.response_ready_i, held,
				     1 + count))
			violation_ = "the response changed before it was taken";
		if (!core_.response_valid_o || !core_.response_ready_i)
			return false;
		if (count > job_->response_words - words_received_) {
			violation_ = "more response words than there is room for";
			return false;
		}
		std::memcpy(job_->response + words_received_, held + 1, 4 * count);
		words_received_ += count;
		return true;
	}

	bool sample_status()
	{
		const uint32_t held[] = { core_.status_o[0], core_.status_o[1], core_.status_o[2] };
		if (!status_.holds(core_.status_valid_o, core_.status_ready_i, held, 3))
			violation_ = "the status changed before it was taken";
		if (!core_.status_valid_o || !core_.status_ready_i)
			return false;
		if (words_sent_ < job_->stream_words)
			violation_ = "the status came before the end of the stream";
		if (words_received_ != held[2])
			violation_ = "the response had another length than the status says";
		if (!memory_.idle())
			violation_ = "the status came before the end of a memory transfer";
		return true;
	}

	VerilatedContext context_;
	Vgloss_core core_{ &context_ };
	SimMemory<Vgloss_core, SIM_LANES> memory_;
	SimStalls stalls_{ 0 };
	const accel_job *job_ = nullptr;
	bool job_waits_ = false, stream_waits_ = false;
	uint64_t words_sent_ = 0, quiet_ = 0;
	uint32_t words_received_ = 0;
	const char *violation_ = "";
	SimHeld<SIM_LANES + 1> response_;
	SimHeld<3> status_;
};

namespace
{

struct gloss_sim *create(void *memory, uint64_t size)
{
	try {
		return new gloss_sim(memory, size);
	} catch (const std::bad_alloc &) {
		return nullptr;
	}
}

void destroy(struct gloss_sim *sim)
{
	delete sim;
}

void stalls(struct gloss_sim *sim, uint64_t seed)
{
	sim->stalls(seed);
}

int run(struct gloss_sim *sim, const struct accel_job *job, uint64_t limit,
	struct gloss_status *status, struct gloss_sim_clocks *clocks)
{
	try {
		int err = sim->run(*job, limit, *status);
		if (clocks)
			*clocks = err ? gloss_sim_clocks{} : sim->clocks();
		return err;
	} catch (const std::bad_alloc &) {
		sim->reset();
		return -ENOMEM;
	}
}

const char *violation(const struct gloss_sim *sim)
{
	return sim->violation();
}

} /* namespace */

extern "C" const struct gloss_sim_ops gloss_sim;
const struct gloss_sim_ops gloss_sim = {
	GLOSS_SIM_ABI, GLOSS_VERSION, SIM_TILE, SIM_LANES, SIM_STREAM_BITS,
	create,	       destroy,	      stalls,	run,	   violation,
};
