#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string>

#include "bench/paper/voronoi.hpp"

namespace camdir::paper {
namespace {

// What the visit of qhull's ridges collects. qhull passes one user pointer to the visitor, typed as FILE.
struct Visit {
    const std::vector<Vec3d>& samples;
    Vec3d origin;
    double min_distance;
    Box3d bounds;
    Faces result;
    std::vector<std::uint32_t> vertex_of;  // by qhull's number of the Voronoi vertex
    std::vector<std::uint32_t> corners;    // scratch
};

constexpr std::uint32_t unused = 0xffffffffU;

Vec3d centre_of(qhT* qh, facetT* facet, const Vec3d& origin) {
    if (facet->center == nullptr) facet->center = qh_facetcenter(qh, facet->vertices);
    return origin + Vec3d(facet->center[0], facet->center[1], facet->center[2]);
}

std::uint32_t vertex_of(qhT* qh, facetT* facet, Visit& visit) {
    if (facet->visitid >= visit.vertex_of.size()) visit.vertex_of.resize(facet->visitid + 1, unused);
    std::uint32_t& vertex = visit.vertex_of[facet->visitid];
    if (vertex == unused) {
        vertex = static_cast<std::uint32_t>(visit.result.faces.vertices.size());
        visit.result.faces.vertices.push_back(centre_of(qh, facet, visit.origin));
    }
    return vertex;
}

// Called by qhull for one Voronoi face: the samples of its two cells, and its corners in order.
void take_face(qhT* qh, FILE* user, vertexT* from, vertexT* to, setT* centres, boolT unbounded) {
    auto& visit = *reinterpret_cast<Visit*>(user);
    const auto [p, q] = std::minmax({static_cast<std::uint32_t>(qh_pointid(qh, from->point)),
                                     static_cast<std::uint32_t>(qh_pointid(qh, to->point))});
    const double distance = (visit.samples[q] - visit.samples[p]).norm();
    if (unbounded != 0 || distance < visit.min_distance) return;

    visit.corners.clear();
    for (int i = 0; i < qh_setsize(qh, centres); ++i) {
        auto* facet = static_cast<facetT*>(SETelem_(centres, i));
        if (!visit.bounds.contains(centre_of(qh, facet, visit.origin))) return;
        const std::uint32_t corner = vertex_of(qh, facet, visit);
        if (std::find(visit.corners.begin(), visit.corners.end(), corner) == visit.corners.end())
            visit.corners.push_back(corner);
    }
    if (visit.corners.size() < 3) return;
    bake::VoronoiFaces& faces = visit.result.faces;
    faces.corners.insert(faces.corners.end(), visit.corners.begin(), visit.corners.end());
    faces.begin.push_back(faces.corners.size());
    faces.generators.push_back({p, q});
    visit.result.generator_distance.push_back(distance);
}

// qhull reports errors by a jump to its errexit: no object with a destructor may live here.
bool visit_faces(qhT* qh, Visit* visit) {
    if (setjmp(qh->errexit) != 0) {
        qh->NOerrexit = True;
        return false;
    }
    qh->NOerrexit = False;
    qh_eachvoronoi_all(qh, reinterpret_cast<FILE*>(visit), take_face, !qh_ALL, qh_RIDGEall, True);
    qh->NOerrexit = True;
    return true;
}

std::uint64_t count_lower_facets(qhT* qh) {
    std::uint64_t count = 0;
    for (facetT* facet = qh->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next)
        count += facet->upperdelaunay ? 0U : 1U;
    return count;
}

// Owns qhull's memory and what it says.
class Qhull {
  public:
    Qhull() : messages_(std::tmpfile()) { qh_zero(&qh_, messages()); }
    ~Qhull() {
        int left = 0;
        int bytes_left = 0;
        qh_freeqhull(&qh_, !qh_ALL);
        qh_memfreeshort(&qh_, &left, &bytes_left);
        if (messages_ != nullptr) std::fclose(messages_);
    }
    Qhull(const Qhull&) = delete;
    Qhull& operator=(const Qhull&) = delete;

    [[nodiscard]] qhT* get() { return &qh_; }
    [[nodiscard]] FILE* messages() { return messages_ != nullptr ? messages_ : stderr; }
    // The first line that it wrote to messages().
    [[nodiscard]] std::string first_message() {
        std::array<char, 256> line{};
        if (messages_ == nullptr) return "";
        std::rewind(messages_);
        while (std::fgets(line.data(), static_cast<int>(line.size()), messages_) != nullptr) {
            const std::string text(line.data(), std::strcspn(line.data(), "\n"));
            if (!text.empty()) return text;
        }
        return "";
    }

  private:
    FILE* messages_;
    qhT qh_{};
};

}  // namespace

Result<Faces> voronoi_by_qhull(const std::vector<Vec3d>& samples, double min_distance, const Box3d& bounds) {
    Stopwatch stopwatch;
    Visit visit{samples, bounds.center(), min_distance, bounds, {}, {}, {}};
    std::vector<coordT> coordinates;
    coordinates.reserve(3 * samples.size());
    for (const Vec3d& sample : samples) {
        const Vec3d p = sample - visit.origin;
        coordinates.insert(coordinates.end(), p.begin(), p.end());
    }
    Qhull qhull;
    std::string command = "qhull v Qbb Qc";  // Voronoi; last coordinate scaled; coplanar points kept
    const int failed = qh_new_qhull(qhull.get(), 3, static_cast<int>(samples.size()), coordinates.data(),
                                    False, command.data(), nullptr, qhull.messages());
    if (failed != 0) return fail("qhull, code " + std::to_string(failed) + ": " + qhull.first_message());
    const Cost diagram = stopwatch.lap();
    visit.result.diagram = diagram;
    visit.result.voronoi_vertices = count_lower_facets(qhull.get());
    if (!visit_faces(qhull.get(), &visit))
        return fail("qhull, while its Voronoi faces are read: " + qhull.first_message());
    return std::move(visit.result);
}

}  // namespace camdir::paper
