#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "evaluation/chunks.hpp"
#include "evaluation/verification_stages.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::uint64_t max_outcomes = 65536;  // held at once

struct Ball {
    Vec3d centre;
    double radius;
};

Ball ball_at(const freespace::Vertex& vertex) {
    return {vertex.position().cast<double>(), vertex.free_distance};
}

// The ball of the slab's point with these barycentric weights.
Ball ball_on(const freespace::Freespace& freespace, std::size_t triangle, double wa, double wb, double wc) {
    const freespace::Triangle& corners = freespace.triangles()[triangle];
    const Ball a = ball_at(freespace.vertices()[corners.a]);
    const Ball b = ball_at(freespace.vertices()[corners.b]);
    const Ball c = ball_at(freespace.vertices()[corners.c]);
    return {wa * a.centre + wb * b.centre + wc * c.centre, wa * a.radius + wb * b.radius + wc * c.radius};
}

// Uniform over the triangle's area.
Ball random_ball_on(const freespace::Freespace& freespace, std::size_t triangle, ChunkRandom& random) {
    const double root = std::sqrt(random.uniform());
    const double along = random.uniform();
    return ball_on(freespace, triangle, 1.0 - root, root * (1.0 - along), root * along);
}

std::vector<double> summed_areas(const freespace::Freespace& freespace) {
    std::vector<double> sums;
    sums.reserve(freespace.triangles().size());
    double sum = 0.0;
    for (const freespace::Triangle& triangle : freespace.triangles()) {
        const Vec3d a = ball_at(freespace.vertices()[triangle.a]).centre;
        const Vec3d b = ball_at(freespace.vertices()[triangle.b]).centre;
        const Vec3d c = ball_at(freespace.vertices()[triangle.c]).centre;
        sum += (b - a).cross(c - a).norm() / 2.0;
        sums.push_back(sum);
    }
    return sums;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Edge> edges_of(const freespace::Freespace& freespace) {
    std::vector<Edge> edges;
    edges.reserve(3 * freespace.triangles().size());
    for (const auto& [a, b, c] : freespace.triangles()) {
        edges.push_back(std::minmax(a, b));
        edges.push_back(std::minmax(b, c));
        edges.push_back(std::minmax(c, a));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

void count_fault(BallFault fault, const UnsafeBall& ball, BallCounts& counts) {
    const auto kind = static_cast<std::size_t>(fault);
    ++counts.unsafe[kind];
    if (!counts.deepest[kind] || ball.excess > counts.deepest[kind]->excess) counts.deepest[kind] = ball;
}

void add(const BallCounts& more, BallCounts& counts) {
    counts.tested += more.tested;
    counts.skipped += more.skipped;
    for (std::size_t kind = 0; kind < counts.unsafe.size(); ++kind) {
        counts.unsafe[kind] += more.unsafe[kind];
        const bool deeper = more.deepest[kind] && (!counts.deepest[kind] ||
                                                   more.deepest[kind]->excess > counts.deepest[kind]->excess);
        if (deeper) counts.deepest[kind] = more.deepest[kind];
    }
}

class BallTest {
  public:
    explicit BallTest(const VerificationJob& job) : job_(job) {}

    // Tests make(i, random) for i < count. Each `purpose` draws other random numbers.
    template <class Make>
    [[nodiscard]] BallCounts run(std::string_view stage, std::uint32_t purpose, std::uint64_t count,
                                 const Make& make) const {
        const auto test_chunk = [&](std::uint64_t chunk) {
            ChunkRandom random(job_.parameters.seed, purpose, chunk);
            BallCounts counts;
            const std::uint64_t end = std::min(count, (chunk + 1) * chunk_size);
            for (std::uint64_t i = chunk * chunk_size; i < end && !job_.stop.stop_requested(); ++i) {
                test(make(i, random), counts);
            }
            return counts;
        };
        const std::uint64_t chunks = (count + chunk_size - 1) / chunk_size;
        BallCounts sum;
        for (std::uint64_t first = 0; first < chunks; first += max_outcomes) {
            const auto outcomes = run_chunks<BallCounts>(
                first, std::min(chunks - first, max_outcomes), job_.stop, test_chunk,
                [&](std::uint64_t done) { job_.progress(stage, first + done, chunks); });
            for (const BallCounts& counts : outcomes) {
                add(counts, sum);
            }
        }
        return sum;
    }

  private:
    void test(const Ball& ball, BallCounts& counts) const {
        if (ball.radius <= 0.0) {
            ++counts.skipped;
            return;
        }
        ++counts.tested;
        const double clearance = job_.oracle.clearance(ball.centre, ball.radius);
        if (job_.oracle.in_solid(ball.centre))
            count_fault(BallFault::centre_in_solid, {ball.centre, ball.radius, -clearance}, counts);
        else if (clearance < ball.radius - job_.tolerance)
            count_fault(BallFault::surface_inside, {ball.centre, ball.radius, ball.radius - clearance},
                        counts);
        else if (!job_.reachability.reachable(ball.centre))
            count_fault(BallFault::centre_unreachable, {ball.centre, ball.radius, 0.0}, counts);
    }

    const VerificationJob& job_;
};

}  // namespace

Result<void> verify_balls(const VerificationJob& job, Verification& result) {
    const freespace::Freespace& freespace = job.freespace;
    const auto vertices = freespace.vertices();
    const std::size_t triangle_count = freespace.triangles().size();
    const std::vector<double> areas = summed_areas(freespace);
    const std::vector<Edge> edges = edges_of(freespace);
    const std::uint64_t by_area = triangle_count == 0 ? 0 : job.parameters.balls / 2;
    const std::uint64_t by_triangle = triangle_count == 0 ? 0 : job.parameters.balls - by_area;
    const BallTest test(job);

    result.by_area = test.run("balls by area", 1, by_area, [&](std::uint64_t, ChunkRandom& random) {
        const auto chosen = std::upper_bound(areas.begin(), areas.end(), random.uniform() * areas.back());
        const auto triangle = std::min(static_cast<std::size_t>(chosen - areas.begin()), triangle_count - 1);
        return random_ball_on(freespace, triangle, random);
    });
    result.by_triangle =
        test.run("balls by triangle", 2, by_triangle, [&](std::uint64_t, ChunkRandom& random) {
            return random_ball_on(freespace, random.below(triangle_count), random);
        });
    result.at_vertices = test.run("balls at vertices", 3, vertices.size(),
                                  [&](std::uint64_t i, ChunkRandom&) { return ball_at(vertices[i]); });
    result.at_edges = test.run("balls at edges", 4, edges.size(), [&](std::uint64_t i, ChunkRandom&) {
        const Ball a = ball_at(vertices[edges[i].first]);
        const Ball b = ball_at(vertices[edges[i].second]);
        return Ball{(a.centre + b.centre) / 2.0, (a.radius + b.radius) / 2.0};
    });
    if (job.stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    return {};
}

}  // namespace camdir::evaluation
