/* SPDX-License-Identifier: MIT */
/*
 * Board memory as the tile stage sees it: reads and writes of rows, in order, with any latency. It is
 * as unkind as AXI allows: a write may be in memory as soon as its last beat is taken or as late as
 * its acknowledgement, a read may look as soon as it is asked or as late as its first beat.
 */
#ifndef TESTS_TILE_MEMORY_H
#define TESTS_TILE_MEMORY_H

#include "tile_work.h"

class TileMemory
{
      public:
	/* When an address of a write is taken. */
	enum Address { ANY_TIME, WITH_DATA, AFTER_DATA };

	explicit TileMemory(Random &random) : words(memory_units * TILE), random(random)
	{
	}

	/* No stalls and this latency. */
	void steady(int clocks)
	{
		latency_min = latency_max = clocks;
		stalls = false;
		early_read = early_write = false;
		address = ANY_TIME;
	}

	/* Writes come late and reads look early: a load that does not wait for a store shows. */
	void late(int clocks)
	{
		steady(clocks);
		early_read = true;
	}

	void unkind()
	{
		latency_min = random.between(1, 10);
		latency_max = latency_min + random.between(0, 80);
		stalls = true;
		early_read = random.chance(50);
		early_write = random.chance(50);
		address = (Address)random.below(3);
	}

	template <class Top> void drive(Top &top, uint64_t clock)
	{
		bool held = stalls && read_stall.now();

		top.load_ready_i = !(stalls && load_stall.now()) && loads.size() < 32;
		top.load_data_valid_i = !loads.empty() && loads.front().due <= clock && !held;
		if (top.load_data_valid_i)
			answer(top);
		top.store_done_i = !stores.empty() && stores.front().due <= clock;
		held = stalls && data_stall.now();
		top.store_data_ready_i = !held;
		held = stalls && store_stall.now();
		top.store_ready_i = !held && (address == ANY_TIME ||
					      (address == WITH_DATA &&
					       (top.store_data_valid_o || !data.empty())) ||
					      (address == AFTER_DATA && data.size() >= TILE));
	}

	/* drive, but for outputs that depend on nothing but registers: sample, then the edge. */
	template <class Top> void sample(Top &top, uint64_t clock)
	{
		if (top.load_valid_o && top.load_ready_i)
			load(top.load_address_o, clock);
		if (top.load_data_valid_i && ++loads.front().beat == row_beats)
			loads.pop_front();
		if (top.store_done_i) {
			if (!stores.front().written)
				write(stores.front());
			stores.pop_front();
		}
		if (top.store_valid_o && top.store_ready_i) {
			check_address(top.store_address_o);
			addresses.push_back(top.store_address_o);
		}
		if (top.store_data_valid_o)
			take_data(top);
		match(clock);
	}

	bool quiet() const
	{
		return loads.empty() && stores.empty() && addresses.empty() && data.empty();
	}

	std::vector<uint32_t> words;

      private:
	struct Load {
		uint32_t address;
		uint64_t due;
		int beat;
		std::vector<uint32_t> data; /* empty: to be looked up at the first beat */
	};

	struct Store {
		uint32_t address;
		uint64_t due;
		bool written;
		std::vector<uint32_t> data;
	};

	void check_address(uint32_t address)
	{
		TB_CHECK(address % unit == 0 && address / unit < memory_units, "address %08x",
			 address);
	}

	std::vector<uint32_t> row(uint32_t address) const
	{
		return { words.begin() + address / 4, words.begin() + address / 4 + TILE };
	}

	void load(uint32_t address, uint64_t clock)
	{
		uint64_t due = clock + random.between(latency_min, latency_max);
		Load load = { address, due, 0, {} };

		check_address(address);
		if (early_read)
			load.data = row(address);
		loads.push_back(load);
	}

	template <class Top> void answer(Top &top)
	{
		Load &load = loads.front();

		if (load.data.empty())
			load.data = row(load.address);
		for (int l = 0; l < LANES; l++)
			tb_set(top.load_data_i, 32 * l, 32, load.data[load.beat * LANES + l]);
	}

	template <class Top> void take_data(Top &top)
	{
		size_t before = data.size() / TILE, taken = addresses.size();

		TB_CHECK(before < taken + (top.store_valid_o && !top.store_ready_i),
			 "data come before their address");
		if (!top.store_data_ready_i)
			return;
		for (int l = 0; l < LANES; l++)
			data.push_back(tb_get(top.store_data_o, 32 * l, 32));
		TB_CHECK(top.store_data_last_o == (data.size() % TILE == 0),
			 "last beat in the wrong place");
	}

	/* Rows whose address and data are both there. */
	void match(uint64_t clock)
	{
		while (!addresses.empty() && data.size() >= TILE) {
			Store store = { addresses.front(),
					clock + random.between(latency_min, latency_max),
					early_write,
					{ data.begin(), data.begin() + TILE } };

			addresses.pop_front();
			data.erase(data.begin(), data.begin() + TILE);
			if (early_write)
				write(store);
			stores.push_back(store);
		}
	}

	void write(const Store &store)
	{
		for (int at = 0; at < TILE; at++)
			words[store.address / 4 + at] = store.data[at];
	}

	Random &random;
	int latency_min = 20, latency_max = 20;
	bool stalls = false, early_read = false, early_write = false;
	Address address = ANY_TIME;
	Stall load_stall{ random }, read_stall{ random }, store_stall{ random },
		data_stall{ random };

	std::deque<Load> loads;
	std::deque<Store> stores;       /* to be acknowledged */
	std::deque<uint32_t> addresses; /* without data */
	std::deque<uint32_t> data;      /* words without address */
};

#endif
