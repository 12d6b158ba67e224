// SPDX-License-Identifier: MIT
/* raster_edge: real edges against exact division, any values against the rule of gloss.xml. */
#include "Vraster_edge.h"
#include "raster_record.h"

template <typename Port> static void set_line(Port &port, const model_edge &edge)
{
	tb_set(port, 0, 16, edge.dy);
	tb_set(port, 16, 16, edge.m);
	tb_set(port, 32, 16, edge.r);
	tb_set(port, 48, 13, edge.step & 0x1fff);
	tb_set(port, 61, 13, edge.x & 0x1fff);
}

static int sign13(int x)
{
	return (x & 0xfff) - (x & 0x1000);
}

/* Drives the edge as raster_walk does: the remainder one step ahead of x, with random waits. */
class Edge {
public:
	explicit Edge(Random &random) : random(random) {}

	/* Row 0 is out after this. */
	void take(const model_edge &line)
	{
		set_line(bench.top.line_i, line);
		clock(1, 1, 0, 1, 0);
		set_line(bench.top.line_i, edge_any(random));
		pending = false;
	}

	/* On to the next row; the one after it is the first of the middle edge if @take_next. */
	void step(bool switched, bool take_next)
	{
		if (!pending)
			clock(0, switched, 1, 0, 0);
		clock(0, take_next, 1, switched, 1);
		pending = true;
	}

	void middle(const model_edge &line) { set_line(bench.top.middle_i, line); }

	int x() { return sign13(bench.top.x_o); }

private:
	Random &random;
	Bench<Vraster_edge> bench;
	bool pending = false; /* the remainder is a step ahead */

	void clock(int idle, int take_r, int step_r, int take_x, int step_x)
	{
		Vraster_edge &top = bench.top;

		while (random.chance(20)) {
			top.take_r_i = top.step_r_i = top.take_x_i = top.step_x_i = 0;
			bench.tick();
		}
		top.idle_i = idle;
		top.take_r_i = take_r, top.step_r_i = step_r;
		top.take_x_i = take_x, top.step_x_i = step_x;
		bench.tick();
	}
};

static Point point_any(Random &random)
{
	return { random.between(-16000, 16000), random.between(-16000, 16000) };
}

static void real_edges_are_exact(Random &random, Edge &edge)
{
	for (int n = 0; n < 5000; n++) {
		Point top = point_any(random), bottom = point_any(random);

		if (top.y > bottom.y)
			std::swap(top, bottom);
		int first = first_row(top.y), end = std::min(first_row(bottom.y), first + 64);

		if (first >= end)
			continue;
		edge.take(edge_between(top, bottom, first));
		for (int row = first; row < end; row++) {
			int64_t dx = bottom.x - top.x, dy = bottom.y - top.y;
			/* the least x with 16 x + 8 >= the edge's place at the row's centre */
			int64_t place = top.x * dy + dx * (16 * row + 8 - top.y) - 8 * dy;
			int least = -floor_div(-place, 16 * dy);

			if (row > first)
				edge.step(false, false);
			TB_CHECK(edge.x() == sign13(least), "x is %d instead of %d in row %d",
				 edge.x(), least, row - first);
		}
	}
}

static void any_values_wrap_as_the_interface_says(Random &random, Edge &edge)
{
	for (int n = 0; n < 5000; n++) {
		model_edge now = edge_any(random), middle = edge_any(random);
		int rows = random.between(1, 64), change = random.between(1, 64);

		edge.middle(middle);
		edge.take(now);
		for (int row = 1; row < rows; row++) {
			edge.step(row == change, row + 1 == change);
			uint32_t r = (now.r + now.m) & 0xffff;
			uint32_t carry = r >= now.dy;

			now.r = carry ? r - now.dy : r;
			now.x = sign13(now.x + now.step + carry);
			if (row == change)
				now = middle;
			TB_CHECK(edge.x() == now.x, "x is %d instead of %d in row %d", edge.x(),
				 now.x, row);
		}
	}
}

int main()
{
	Random random(tb_seed());
	Edge edge(random);

	real_edges_are_exact(random, edge);
	any_values_wrap_as_the_interface_says(random, edge);
	printf("raster_edge: real edges are exact, any values wrap\n");
	return 0;
}
