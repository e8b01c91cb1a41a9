// A game loop with hair in it: game_loop GROOM HEAD.obj MOTION.csv [SECONDS]. Frames take uneven times, as they do in games; the hair steps evenly.
// MOTION.csv: a line of titles, then time (s), position (m), unit quaternion w, x, y, z of the head.
#include "hair_component.hpp"
#include "obj_mesh.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>

// The head's recorded poses. The hair's space is that of the first, about the head's middle.
class HeadMotion {
 public:
  HeadMotion(const std::string &path, const superhelix::vec3 &middle) : middle_(middle) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      Sample s;
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &s.time, &s.position[0], &s.position[1], &s.position[2], &s.rotation[3],
                      &s.rotation[0], &s.rotation[1], &s.rotation[2]) != 8)
        throw std::runtime_error(path + ": a line without eight numbers: " + line);
      samples_.push_back(s);
    }
    if (samples_.empty())
      throw std::runtime_error(path + ": holds no pose");
  }

  // Relative to the first pose: the head turns about its middle.
  Pose at(double time) const {
    const auto next = std::find_if(samples_.begin(), samples_.end(), [&](const Sample &s) { return s.time >= time; });
    const Sample &b = next == samples_.end() ? samples_.back() : *next;
    const Sample &a = next == samples_.begin() || next == samples_.end() ? b : *(next - 1);
    const double u = b.time > a.time ? (time - a.time) / (b.time - a.time) : 0.0;
    double dot = 0.0, norm = 0.0;
    superhelix::quaternion q{};
    for (std::size_t k = 0; k < 4; k++)
      dot += a.rotation[k] * b.rotation[k];
    for (std::size_t k = 0; k < 4; k++) {
      q[k] = (1.0 - u) * (dot < 0.0 ? -1.0 : 1.0) * a.rotation[k] + u * b.rotation[k];
      norm += q[k] * q[k];
    }
    for (double &number : q)
      number /= std::sqrt(norm);
    // The turn since the first pose: q times its conjugate.
    const Sample &first = samples_.front();
    const auto &f = first.rotation;
    const superhelix::frame turn = Pose{{}, q} * superhelix::make_frame({}, {-f[0], -f[1], -f[2], f[3]});
    Pose pose{{}, {turn.rotation[0], turn.rotation[1], turn.rotation[2], turn.rotation[3]}};
    const superhelix::vec3 arm = pose.rotate(middle_);
    for (std::size_t k = 0; k < 3; k++)
      pose.position[k] = middle_[k] - arm[k] + (1.0 - u) * a.position[k] + u * b.position[k] - first.position[k];
    return pose;
  }

 private:
  struct Sample {
    double time = 0.0;
    superhelix::vec3 position{};
    superhelix::quaternion rotation{};
  };
  std::vector<Sample> samples_;
  superhelix::vec3 middle_;
};

static int run(int argc, char **argv) {
  const double seconds = argc > 4 ? std::stod(argv[4]) : 2.0;
  const ObjMesh head = ObjMesh::read(argv[2], 0.01);
  superhelix::vec3 middle{};
  for (const auto &vertex : head.vertices)
    for (std::size_t k = 0; k < 3; k++)
      middle[k] += vertex[k] / static_cast<double>(head.vertices.size());
  const HeadMotion motion(argv[3], middle);

  HairComponent::Settings settings;
  settings.render_strands = 4000;
  settings.points_per_strand = 12;
  settings.worker_count = 2;
  HairComponent hair(argv[1], head.vertices, head.triangles, settings);
  std::vector<HairVertex> vertices(hair.vertex_count());
  std::printf("%zu guides, %zu render strands, %zu vertices of %zu bytes, %zu lines\n", hair.guide_count(), hair.strand_count(), vertices.size(),
              sizeof(HairVertex), hair.line_indices().size());

  // Frames of 11 to 22 ms; one that hangs for half a second, which drops time.
  double time = 0.0, worst = 0.0, longest_edge = 0.0;
  std::uint64_t unconverged = 0, quarantined = 0;
  int frames = 0;
  for (; time < seconds; frames++) {
    const double frame_seconds = frames == 40 ? 0.5 : 0.0165 + 0.0055 * std::sin(1.7 * frames);
    time += frame_seconds;
    const auto start = std::chrono::steady_clock::now();
    const Pose pose = motion.at(time);
    hair.update(frame_seconds, pose);
    hair.fill(vertices, pose.position);
    worst = std::max(worst, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    unconverged += hair.report().unconverged;
    quarantined += hair.report().quarantined;
    for (std::size_t i = 1; i < vertices.size(); i++) {
      const auto &a = vertices[i - 1], &b = vertices[i];
      double square = 0.0;
      for (std::size_t k = 0; k < 3; k++) {
        const double d = static_cast<double>(b.position_radius[k]) - static_cast<double>(a.position_radius[k]);
        if (!std::isfinite(d) || !std::isfinite(b.velocity[k]))
          throw std::runtime_error("a vertex is not finite");
        square += d * d;
      }
      if (b.along > a.along)
        longest_edge = std::max(longest_edge, std::sqrt(square));
    }
  }
  std::printf("%d frames, %.2f s; dearest frame %.1f ms\n", frames, time, 1000.0 * worst);
  std::printf("%llu strand steps unconverged, %llu quarantined; longest edge %.1f mm\n", static_cast<unsigned long long>(unconverged),
              static_cast<unsigned long long>(quarantined), 1000.0 * longest_edge);

  hair.teleport(Pose{{100.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}});
  hair.fill(vertices, {100.0, 0.0, 0.0});
  std::printf("teleported; the first root is at %.3f %.3f %.3f\n", static_cast<double>(vertices[0].position_radius[0]),
              static_cast<double>(vertices[0].position_radius[1]), static_cast<double>(vertices[0].position_radius[2]));
  return 0;
}

int main(int argc, char **argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: game_loop GROOM HEAD.obj MOTION.csv [SECONDS]\n");
    return 2;
  }
  try {
    return run(argc, argv);
  } catch (const std::exception &why) {
    std::fprintf(stderr, "game_loop: %s\n", why.what());
    return 1;
  }
}
