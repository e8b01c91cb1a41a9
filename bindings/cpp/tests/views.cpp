// Views, ids, definitions: what needs no solver.
#include "check.hpp"

#include <memory>
#include <type_traits>
#include <unordered_set>
#if __cplusplus >= 202002L
#include <span>
#endif

using namespace superhelix;

static_assert(!std::is_copy_constructible_v<solver> && std::is_nothrow_move_constructible_v<solver> && std::is_nothrow_move_assignable_v<solver>);
static_assert(!std::is_copy_constructible_v<curves> && std::is_nothrow_move_constructible_v<curves>);
static_assert(!std::is_copy_constructible_v<scalp> && std::is_nothrow_move_constructible_v<scalp>);
static_assert(!std::is_copy_constructible_v<render_hair> && std::is_nothrow_move_constructible_v<render_hair>);
static_assert(!std::is_copy_constructible_v<render_pose> && std::is_nothrow_move_constructible_v<render_pose>);
static_assert(!std::is_copy_constructible_v<curve_cache_writer> && std::is_nothrow_move_constructible_v<curve_cache_writer>);
// Ids of one kind are no ids of another.
static_assert(!std::is_convertible_v<strand_id, body_id> && !std::is_convertible_v<body_id, constraint_id>);
// Room to write into is never constant, and never a temporary.
static_assert(std::is_convertible_v<std::vector<double> &, span<double>> && !std::is_convertible_v<const std::vector<double> &, span<double>>);
static_assert(!std::is_convertible_v<std::vector<double>, span<double>> && std::is_convertible_v<std::vector<double>, span<const double>>);
static_assert(!std::is_convertible_v<std::vector<float> &, span<double>>);
// Definitions lie in arrays as the C structures do.
static_assert(sizeof(strand_def) == sizeof(shx_strand_def) && sizeof(body_def) == sizeof(shx_body_def));
static_assert(sizeof(material) == sizeof(shx_material) && sizeof(constraint_def) == sizeof(shx_constraint_def));

// A definition must not keep a temporary.
static_assert(std::is_convertible_v<std::vector<double> &, kept<const double>> && !std::is_convertible_v<std::vector<double>, kept<const double>>);
static_assert(std::is_convertible_v<span<const double>, kept<const double>> && !std::is_convertible_v<double, kept<const double>>);
static_assert(std::is_convertible_v<std::vector<vec3> &, kept_input> && !std::is_convertible_v<std::vector<vec3>, kept_input>);
static_assert(std::is_convertible_v<input, kept_input> && std::is_convertible_v<frame &, kept_input> && !std::is_convertible_v<frame, kept_input>);

static std::size_t size_of(span<const double> numbers) { return numbers.size(); }

TEST(spans_take_what_is_contiguous) {
  std::vector<double> vector{1.0, 2.0, 3.0};
  const std::array<double, 2> array{4.0, 5.0};
  double plain[4] = {6.0, 7.0, 8.0, 9.0};
  EXPECT(size_of(vector) == 3 && size_of(array) == 2 && size_of(plain) == 4 && size_of({1.0, 2.0}) == 2 && size_of({}) == 0);
  EXPECT(size_of(plain[1]) == 1 && size_of(nullptr) == 0);
  const span<double> view(vector);
  view[1] = 20.0;
  EXPECT(vector[1] == 20.0 && view.data() == vector.data() && view.subspan(1, 2)[0] == 20.0 && view.first(1).size() == 1);
  double sum = 0.0;
  for (const double number : span<const double>(view))
    sum += number;
  EXPECT(sum == 24.0);
#if __cplusplus >= 202002L
  EXPECT(size_of(std::span<double>(vector)) == 3);
#endif
}

TEST(ids_compare_and_hash) {
  const strand_id none{}, one{1}, two{2};
  EXPECT(none == strand_id{} && one != two && one < two);
  const std::unordered_set<strand_id> set{one, two, one};
  EXPECT(set.size() == 2 && set.count(two) == 1);
}

struct vertex {
  float position[3];
  std::array<float, 4> other;
  float spare;
};

TEST(inputs_and_outputs_point_to_the_hosts_memory) {
  std::vector<std::array<float, 3>> points(5);
  const input from(points);
  EXPECT(from.data == points.data() && from.stride == 12 && from.count == 5 && from.format == SHX_FORMAT_F32X3);
  std::vector<vertex> vertices(7);
  const output to = output::of(vertices, &vertex::position);
  EXPECT(to.data == &vertices[0].position && to.stride == sizeof(vertex) && to.count == 7 && to.format == SHX_FORMAT_F32X3);
  const output fours = output::of(vertices, &vertex::other);
  EXPECT(fours.data == &vertices[0].other && fours.format == SHX_FORMAT_F32X4);
  std::vector<double> numbers(12);
  EXPECT(output::xyz(numbers).count == 4 && output::xyzw(numbers).count == 3 && output::xyzw(numbers).format == SHX_FORMAT_F64X4);
  EXPECT(input::xyz(span<const double>(numbers)).format == SHX_FORMAT_F64X3);
  const frame one = make_frame({1.0, 2.0, 3.0});
  EXPECT(input(one).data == &one && input(one).count == 1 && input(one).format == SHX_FORMAT_FRAME && one.rotation[3] == 1.0);
  EXPECT(output().data == nullptr && input().count == 0);
  std::vector<std::array<double, 3>> none;
  EXPECT(input(none).count == 0);
}

TEST(definitions_hold_the_defaults) {
  const solver_def def;
  shx_solver_def plain;
  EXPECT(shx_solver_def_init(&plain, sizeof plain) == SHX_OK);
  EXPECT(def.struct_size == sizeof plain && def.tolerance == plain.tolerance && def.gravity[2] == -9.81);
  const auto changed =
      solver_def().with_gravity({0.0, -9.81, 0.0}).with_integrator(integrator::implicit_euler).with_exact_hessian(false).with_worker_count(2);
  EXPECT(changed.gravity[1] == -9.81 && changed.integrator == SHX_INTEGRATOR_IMPLICIT_EULER && changed.exact_hessian == 0);
  EXPECT(changed.worker_count == 2 && changed.integrator == integrator::implicit_euler);
  const std::vector<curvature> rows(6, curvature{0.0, 10.0, 0.0});
  const std::vector<double> lengths(6, 0.01);
  const auto strand = strand_def().with_natural_curvatures(rows).with_element_lengths(lengths).with_radius(4e-5);
  EXPECT(strand.element_count == 6 && strand.natural_curvatures == rows[0].data() && strand.element_lengths == lengths.data());
  EXPECT(strand.radius[0] == 4e-5 && strand.radius[1] == 4e-5);
}

#if !SUPERHELIX_USE_RESULTS
TEST(definitions_refuse_arrays_that_disagree) {
  const std::vector<curvature> six(6), five(5);
  const auto why = WHY(strand_def().with_natural_curvatures(six).with_initial_curvatures(five));
  EXPECT(why.code() == SHX_ERROR_INVALID_ARGUMENT && std::string(why.name()) == "SHX_ERROR_INVALID_ARGUMENT");
  EXPECT(std::string(why.what()).find("strand_def.initial_curvatures is of 5 items") != std::string::npos);
  // The count alone cannot run away from its arrays either.
  WHY(strand_def().with_natural_curvatures(six).with_element_count(7));
  const std::vector<vec3> points(4);
  const std::vector<float> thickness(3);
  WHY(curve_data().with_points(points).with_thickness(thickness));
}
#endif

TEST(moving_takes_ownership) {
  solver first = GET(solver::create());
  shx_solver *raw = first.get();
  solver second(std::move(first));
  EXPECT(second.get() == raw && first.get() == nullptr && !first);
  solver third = GET(solver::create());
  third = std::move(second);
  EXPECT(third.get() == raw && !second);
  // An empty one is refused, not followed.
  EXPECT(WHY(second.strand_count()).code() == SHX_ERROR_NULL_ARGUMENT);
}

TEST(results_hold_a_value_or_an_error) {
  result<int> good(3);
  EXPECT(good.ok() && *good == 3 && good.value() == 3);
  const result<int> bad(error(SHX_ERROR_BUSY, "in use"));
  EXPECT(!bad && bad.error().code() == SHX_ERROR_BUSY && result<int>(bad).value_or(7) == 7);
  const result<std::unique_ptr<int>> owner(std::make_unique<int>(5));
  EXPECT(**owner == 5);
  EXPECT(std::string(result_name(SHX_ERROR_BUSY)) == "SHX_ERROR_BUSY");
  EXPECT(abi_version() == SHX_ABI_VERSION && version() == (SHX_VERSION) && std::string(build_info()).find("superhelix") == 0);
}
