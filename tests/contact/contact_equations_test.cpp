// The contact block against finite differences at states that solve nothing, its elimination against the dense system,
// and what it means geometrically against closed forms.
#include "genu/contact/contact_equations.h"

#include <cmath>

#include <gtest/gtest.h>

#include "contact/contact_pairs.h"
#include "genu/contact/local_minimum.h"
#include "genu/core/decompositions.h"
#include "genu/motion/tolerances.h"
#include "support/finite_difference.h"
#include "support/transport.h"

namespace genu {
namespace {

using test::random_point;
using test::random_pose;
using test::relative_error;
using test::some_surfaces;
using test::touching;

constexpr double kContactForce = 137;  // N
constexpr double kDifferenceStep =
    2e-5;  // m and rad of a finite difference: truncation (h / 5 mm)^4, rounding 1e-17 m / h

struct Contact {
  const Surface *A, *B;
  Pose X_Wa, X_Wb;
  ContactGeometry geometry;

  /// The state after a change of the unknowns [v_a, w_a, v_b, w_b, ds_A, ds_B].
  Contact moved(const VecX& change) const {
    Contact out = *this;
    out.X_Wa = retract(X_Wa, change.head<6>());
    out.X_Wb = retract(X_Wb, change.segment<6>(6));
    EXPECT_TRUE(A->retract(geometry.a, change.segment<2>(12), out.geometry.a));
    EXPECT_TRUE(B->retract(geometry.b, change.segment<2>(14), out.geometry.b));
    out.geometry.a = test::transported(geometry.a, out.geometry.a);
    out.geometry.b = test::transported(geometry.b, out.geometry.b);
    return out;
  }
  ContactBlock block() const {
    ContactBlock out;
    evaluate_contact(X_Wa, X_Wb, geometry, kContactForce, out);
    return out;
  }
};

/// Both bodies placed at random; the points coincide to a few millimetres and the normals are far from opposed.
Contact random_contact(const Surface& A, const Surface& B, std::mt19937& random) {
  Contact c{&A, &B, random_pose(random, 0.05), {}, {random_point(A, random), random_point(B, random)}};
  c.X_Wb = c.X_Wa * touching(c.geometry.a, c.geometry.b, 1);
  Vec6 off;
  off << test::random_vector(random, 3e-3), test::random_vector(random, 0.4);
  c.X_Wb = retract(c.X_Wb, off);
  return c;
}

/// Calls check(contact, what) for random states of every pair of surfaces.
template <typename Check>
void for_random_contacts(Check check) {
  std::mt19937 random(11);
  const auto surfaces = some_surfaces();
  for (const auto& a : surfaces)
    for (const auto& b : surfaces)
      for (int repeat = 0; repeat < 3; ++repeat)
        check(random_contact(*a.surface, *b.surface, random), a.name + " on " + b.name);
}

TEST(ContactEquations, ResidualsDerivatives) {
  double worst = 0;
  for_random_contacts([&](const Contact& c, const std::string& what) {
    const ContactBlock block = c.block();
    MatX exact(5, 16);
    exact << block.d_twist, block.d_surface;
    const MatX difference = test::jacobian([&](const VecX& x) { return VecX(c.moved(x).block().residual); },
                                           VecX::Zero(16), kDifferenceStep);
    // Row by row: lengths and sines do not share a size.
    for (int row = 0; row < 5; ++row) {
      const double error = relative_error(exact.row(row), difference.row(row));
      worst = std::max(worst, error);
      ASSERT_LT(error, 1e-8) << what << ", row " << row << "\n" << exact.row(row) << "\n" << difference.row(row);
    }
  });
  RecordProperty("worst", std::to_string(worst));
}

TEST(ContactEquations, WrenchesDerivatives) {
  for_random_contacts([&](const Contact& c, const std::string& what) {
    const ContactBlock block = c.block();
    MatX exact(12, 16);
    exact << block.wrench_d_twist, block.wrench_d_surface;
    const MatX difference =
        test::jacobian([&](const VecX& x) { return VecX(kContactForce * c.moved(x).block().direction); },
                       VecX::Zero(16), kDifferenceStep);
    for (const int part : {0, 3, 6, 9}) {  // forces and moments by themselves
      const double scale =
          std::max(exact.middleRows<3>(part).cwiseAbs().maxCoeff(), kContactForce * (part % 6 == 0 ? 1 : 0.01));
      const double error = (exact - difference).middleRows<3>(part).cwiseAbs().maxCoeff() / scale;
      ASSERT_LT(error, 1e-8) << what << ", rows from " << part;
    }
  });
}

TEST(ContactEquations, ForceActsEquallyOnBothBodies) {
  for_random_contacts([](const Contact& c, const std::string& what) {
    const Vec12 d = c.block().direction;
    const Vec3 lever = c.X_Wb.p - c.X_Wa.p;
    EXPECT_LT((d.head<3>() + d.segment<3>(6)).norm(), 1e-15) << what;
    EXPECT_LT((d.segment<3>(3) + d.tail<3>() + lever.cross(d.segment<3>(6))).norm(), 1e-15) << what;
    EXPECT_NEAR(d.head<3>().norm(), 1, 1e-14) << what;
  });
}

TEST(ContactEquations, EliminationIsTheDenseSystem) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int eliminated = 0;
  for_random_contacts([&](const Contact& c, const std::string& what) {
    const ContactBlock block = c.block();
    EliminatedContact contact;
    if (!contact.factor(block, 0.02)) return;
    ++eliminated;
    const Vec12 twist = Vec12::NullaryExpr([&] { return 1e-3 * unit(random); });
    // A residual of another state than the factored one.
    Vec5 residual = block.residual;
    for (int i = 0; i < 5; ++i) residual[i] += 1e-3 * unit(random);
    contact.set_residual(residual);

    Mat4 rows;
    rows << block.d_surface.topRows<2>(), block.d_surface.bottomRows<2>();
    Vec5 known = residual + block.d_twist * twist;
    const Vec4 ds = -rows.fullPivLu().solve(Vec4(known[0], known[1], known[3], known[4]));
    const double gap = known[2] + block.d_surface.row(2).dot(ds);
    const Vec12 wrench = block.wrench_d_twist * twist + block.wrench_d_surface * ds;

    const double tolerance = 1e-13 / contact.rcond;
    const Vec4 ds_eliminated = contact.surface_offset + contact.surface_gain * twist;
    EXPECT_LT((ds_eliminated - ds).norm(), tolerance * ds.norm()) << what;
    EXPECT_NEAR(contact.gap + contact.gap_gradient.dot(twist), gap, tolerance * ds.norm()) << what;
    EXPECT_LT((contact.wrench_offset + contact.stiffness * twist - wrench).norm(), tolerance * wrench.norm()) << what;
  });
  EXPECT_GT(eliminated, 80);  // of 108: plane on plane alone is singular
}

/// Touching states whose contact is a strict minimum of the gap.
template <typename Check>
void for_minimal_contacts(Check check) {
  std::mt19937 random(3);
  const auto surfaces = some_surfaces();
  for (const auto& a : surfaces)
    for (const auto& b : surfaces)
      for (int repeat = 0; repeat < 4; ++repeat) {
        Contact c{a.surface.get(),
                  b.surface.get(),
                  random_pose(random, 0.05),
                  {},
                  {random_point(*a.surface, random), random_point(*b.surface, random)}};
        c.X_Wb = c.X_Wa * touching(c.geometry.a, c.geometry.b, 0.7);
        if (symmetric_eigenvalues(relative_curvature(c.X_Wa, c.X_Wb, c.geometry))[0] > 10)
          check(c, a.name + " on " + b.name);
      }
}

TEST(ContactEquations, GapGradientIsThatOfTheRefinedGap) {
  int checked = 0;
  for_minimal_contacts([&](const Contact& c, const std::string& what) {
    EliminatedContact contact;
    ASSERT_TRUE(contact.factor(c.block(), 0.02)) << what;
    const auto gap = [&](const Pose& X_Wa, const Pose& X_Wb) -> VecX {
      const auto descent = descend_gap(*c.A, *c.B, X_Wa.inverse() * X_Wb, c.geometry.b.p, {.max_step = 1e-3});
      EXPECT_TRUE(descent && descent->settled) << what;
      return VecX::Constant(1, descent ? descent->minimum.gap : NAN);
    };
    const MatX difference = test::twist_difference(gap, c.X_Wa, c.X_Wb, 5e-5);
    EXPECT_LT((contact.gap_gradient.transpose() - difference).cwiseAbs().maxCoeff(), 1e-8)
        << what << "\n"
        << contact.gap_gradient.transpose() << "\n"
        << difference;
    ++checked;
  });
  EXPECT_GT(checked, 30);
}

TEST(ContactEquations, RelativeCurvatureIsTheHessianOfTheGap) {
  // The gap of B's points over the common tangent plane, by finite differences, whatever the surfaces are.
  for_minimal_contacts([](const Contact& c, const std::string& what) {
    const Pose X_ab = c.X_Wa.inverse() * c.X_Wb;
    const Mat2 exact = relative_curvature(c.X_Wa, c.X_Wb, c.geometry);
    for (const Vec2& direction : {Vec2(1, 0), Vec2(0, 1), Vec2(0.6, 0.8)}) {
      const Vec2 in_b = (X_ab.R * c.geometry.b.T).transpose() * (c.geometry.a.T * direction);
      const double hessian = test::second_derivative(
          [&](double s) {
            SurfacePoint moved;
            EXPECT_TRUE(c.B->retract(c.geometry.b, s * in_b, moved));
            return c.A->gap(X_ab * moved.p).value_or(NAN);
          },
          4e-4);
      EXPECT_NEAR(direction.dot(exact * direction), hessian, 1e-4 * exact.norm()) << what;
    }
  });
}

Mat2 curvature_at(const Surface& a, const Vec3& at_a, const Surface& b, const Vec3& at_b, double spin) {
  ContactGeometry contact;
  EXPECT_TRUE(a.project(at_a, contact.a) && b.project(at_b, contact.b));
  const Pose X_ab = touching(contact.a, contact.b);
  const Pose turned{exp_rotation(spin * contact.a.n), contact.a.p - exp_rotation(spin * contact.a.n) * contact.a.p};
  return relative_curvature({}, turned * X_ab, contact);
}

TEST(ContactEquations, RelativeCurvatureInClosedForm) {
  const auto plane = make_plane({}, false), sphere = make_sphere({}, 0.02, false),
             socket = make_sphere({}, 0.025, true);
  const auto torus = make_torus({}, 0.015, 0.005, false), cylinder = make_cylinder({}, 0.01, false);
  const auto expect = [](const Mat2& m, double low, double high) {
    EXPECT_NEAR(symmetric_eigenvalues(m)[0], low, 1e-11);
    EXPECT_NEAR(symmetric_eigenvalues(m)[1], high, 1e-11);
  };
  const Vec3 x = Vec3::UnitX();
  expect(curvature_at(*sphere, x, *plane, Vec3::Zero(), 0.3), 50, 50);
  expect(curvature_at(*sphere, x, *sphere, x, 0.3), 100, 100);
  expect(curvature_at(*sphere, x, *socket, x, 0.3), 10, 10);
  expect(curvature_at(*torus, x, *plane, Vec3::Zero(), 0.3), 50, 200);
  expect(curvature_at(*torus, 1e-3 * x, *plane, Vec3::Zero(), 0.3), -100, 200);  // the inner equator: a saddle
  expect(curvature_at(*cylinder, x, *plane, Vec3::Zero(), 0.3), 0, 100);
  // Two cylinders crossing at the angle t: k (1 +- cos t). `touching` lays the tangents of one along the other's.
  for (const double t : {0.4, 1.0, 1.5}) {
    const Vec2 k = symmetric_eigenvalues(curvature_at(*cylinder, x, *cylinder, x, t));
    EXPECT_NEAR(k.sum(), 200, 1e-11);
    EXPECT_NEAR(std::min(std::abs(k[0] - 100 * (1 - std::cos(t))), std::abs(k[0] - 100 * (1 - std::sin(t)))), 0, 1e-9);
  }
}

TEST(ContactEquations, VanishingRelativeCurvatureIsNamedSingular) {
  const auto plane = make_plane({}, false), sphere = make_sphere({}, 0.02, false),
             cylinder = make_cylinder({}, 0.01, false);
  const auto matching = make_sphere({}, 0.02, true);
  const auto regular = [&](const Surface& a, const Surface& b) {
    ContactGeometry contact;
    EXPECT_TRUE(a.project({0.1, 0, 0}, contact.a) && b.project({0.1, 0, 0}, contact.b));
    ContactBlock block;
    evaluate_contact({}, touching(contact.a, contact.b), contact, 10, block);
    EliminatedContact eliminated;
    return eliminated.factor(block, 0.02);
  };
  EXPECT_FALSE(regular(*plane, *plane));
  EXPECT_FALSE(regular(*cylinder, *plane));
  EXPECT_FALSE(regular(*sphere, *matching));
  EXPECT_TRUE(regular(*sphere, *plane));
  EXPECT_TRUE(regular(*sphere, *cylinder));
  // With 0.02 m as the length, a sphere in a socket of 1e-6 relative clearance still leaves its rcond above 1e-8.
  EXPECT_TRUE(regular(*sphere, *make_sphere({}, 0.02 * (1 + 1e-6), true)));
}

TEST(ContactEquations, SpheresThatFillTheirSocketsAreNamedSingularWhateverTheirSize) {
  // Both relative curvatures vanish: the block lacks two ranks, and all its cofactors and its determinant are rounding.
  int named = 0, all = 0;
  for (double radius = 1e-3; radius < 0.1; radius *= 1.037)
    for (const Vec3& way : {Vec3(3, -4, -12), Vec3(10, 20, -30), Vec3(3.3, -4.1, -12.7), Vec3(0.1, 7, 1)}) {
      const auto ball = make_sphere({}, radius, false), socket = make_sphere({}, radius, true);
      ContactGeometry contact;
      ASSERT_TRUE(ball->project(radius * way.normalized(), contact.a));
      ASSERT_TRUE(socket->project(radius * way.normalized(), contact.b));
      // Moved by rounding, as where a solver ends.
      const Pose X_Wa{Mat3::Identity(), 1e-16 * way};
      ContactBlock block;
      evaluate_contact(X_Wa, {}, contact, 10, block);
      for (const double length : {0.005, radius, 0.05}) {
        EliminatedContact eliminated;
        named += eliminated.factor(block, length) ? 0 : 1;
        ++all;
      }
    }
  EXPECT_EQ(named, all);
}

}  // namespace
}  // namespace genu
