// SPDX-License-Identifier: GPL-2.0-only
// Copyright (c) 2026 The GPUDEM developers
/// \file Contacts of a sphere with a region: shapes against points spread over their faces, trees against the rules of
/// LAMMPS written out recursively, motion against the same region at rest.

#include "step/region_views.hpp"
#include "testing/tolerance.h"

#include <algorithm>
#include <random>

using namespace gpudem;
using namespace gpudem::testing;

namespace {

using Vec = Vec3<double>;
constexpr double tau = 6.28318530717958648;

double norm(const Vec &a)
{
  return std::sqrt(dot(a, a));
}

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double operator()(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random_); }
  bool coin(double chance = 0.5) { return (*this)(0.0, 1.0) < chance; }
  int pick(int n) { return std::min(n - 1, static_cast<int>((*this)(0.0, n))); }
  Vec point(double reach) { return {(*this)(-reach, reach), (*this)(-reach, reach), (*this)(-reach, reach)}; }

 private:
  std::mt19937 random_;
};

Array3 array(const Vec &a)
{
  return {a.x, a.y, a.z};
}

RegionPart randomShape(Dice &dice, RegionKind kind)
{
  RegionPart p;
  p.kind = kind;
  p.inside = dice.coin();
  p.axis = dice.pick(3);
  for (std::size_t d = 0; d < 3; ++d) {
    p.lo[d] = dice(-1.6, -0.4);
    p.hi[d] = dice(0.4, 1.6);
    p.tilt[d] = dice(-0.5, 0.5);
    p.centre[d] = dice(-0.3, 0.3);
  }
  p.radius = dice(0.5, 1.5);
  p.radiusHi = kind == RegionKind::Cone ? dice(0.5, 1.5) : 0.0;
  const Vec n = dice.point(1.0);
  p.normal = array(n * (1.0 / norm(n)));
  return p;
}

constexpr RegionKind shapes[] = {RegionKind::Block,    RegionKind::Prism, RegionKind::Sphere,
                                 RegionKind::Cylinder, RegionKind::Cone,  RegionKind::Plane};

/// Points spread over one face, no farther apart than \p fine.
std::vector<Vec> spread(const RegionPart &p, int face, double fine)
{
  std::vector<Vec> points;
  const RegionShape s = shapeOf(p);
  const auto steps = [&](double length) { return 1 + static_cast<int>(length / fine); };
  const auto sheet = [&](const Vec &corner, const Vec &a, const Vec &b) {
    const int na = steps(norm(a)), nb = steps(norm(b));
    for (int i = 0; i <= na; ++i)
      for (int j = 0; j <= nb; ++j) points.push_back(corner + a * (double(i) / na) + b * (double(j) / nb));
  };
  if (p.kind == RegionKind::Block) {
    const int d = face / 2;
    Vec corner = s.lo, a{0, 0, 0}, b{0, 0, 0};
    if (face & 1) corner[d] = s.hi[d];
    a[(d + 1) % 3] = s.hi[(d + 1) % 3] - s.lo[(d + 1) % 3];
    b[(d + 2) % 3] = s.hi[(d + 2) % 3] - s.lo[(d + 2) % 3];
    sheet(corner, a, b);
  } else if (p.kind == RegionKind::Prism) {
    const Vec edge[3] = {
        {s.hi.x - s.lo.x, 0, 0}, {s.tilt.x, s.hi.y - s.lo.y, 0}, {s.tilt.y, s.tilt.z, s.hi.z - s.lo.z}};
    const int across = 2 - face / 2;
    sheet(face & 1 ? s.lo + edge[across] : s.lo, edge[(across + 1) % 3], edge[(across + 2) % 3]);
  } else if (p.kind == RegionKind::Sphere) {
    const int n = steps(tau / 2 * s.radius);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < 2 * n; ++j) {
        const double a = tau / 2 * i / n, b = tau * j / (2 * n);
        points.push_back(s.centre + Vec{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)} * s.radius);
      }
  } else {
    const double lo = s.lo[s.axis], hi = s.hi[s.axis], top = p.kind == RegionKind::Cone ? s.radiusHi : s.radius;
    const int n = steps(face == 2 ? std::hypot(hi - lo, top - s.radius) : std::max(s.radius, top));
    const int turns = steps(tau * std::max(s.radius, top));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < turns; ++j) {
        const double t = double(i) / n;
        const double rho = face == 2 ? s.radius + t * (top - s.radius) : t * (face ? top : s.radius);
        Vec at = s.centre;
        at[(s.axis + 1) % 3] += rho * std::cos(tau * j / turns);
        at[(s.axis + 2) % 3] += rho * std::sin(tau * j / turns);
        at[s.axis] = face == 2 ? lo + t * (hi - lo) : face ? hi : lo;
        points.push_back(at);
      }
  }
  return points;
}

struct Nearest {
  double distance = 1e9;
  Vec at{};
};
Nearest nearestOf(const std::vector<Vec> &points, const Vec &x)
{
  Nearest n;
  for (const Vec &p : points)
    if (norm(p - x) < n.distance) n = {norm(p - x), p};
  return n;
}

/// The shape alone with the given side and open faces.
std::vector<RegionContact> contactsOf(const std::vector<RegionPart> &parts, const Vec &x, double reach,
                                      const std::vector<PartState> &state = std::vector<PartState>(maxRegionParts))
{
  const std::vector<RegionShape> tree = regionShapes(parts);
  RegionContact c[maxRegionContacts];
  const int n = regionContacts(RegionView{tree.data(), state.data(), static_cast<int>(tree.size())}, x, reach, c);
  return {c, c + std::min(n, maxRegionContacts)};
}

constexpr double fine = 0.04;             // of the points on a face
const double slack = fine * fine / 0.05;  // a nearest point half that far off is farther away by less than this

TEST(RegionShapes, FromOutsideTheNearestPointOfTheClosedFacesTouches)
{
  for (const RegionKind kind : shapes) {
    if (kind == RegionKind::Plane) continue;
    int touching = 0;
    for (unsigned seed = 0; seed < 6; ++seed) {
      Dice dice(seed + 10);
      RegionPart p = randomShape(dice, kind);
      p.inside = false;
      std::vector<Vec> points;
      for (int face = 0; face < faceCount(kind); ++face) {
        const bool open = kind != RegionKind::Sphere && seed > 1 && dice.coin(0.4);
        p.openFace[static_cast<std::size_t>(face)] = open;
        if (open) continue;
        const std::vector<Vec> more = spread(p, face, fine);
        points.insert(points.end(), more.begin(), more.end());
      }
      const RegionShape shape = shapeOf(p);
      for (int k = 0; k < 400; ++k) {
        const Vec x = dice.point(2.2);
        const double reach = dice(0.2, 0.8);
        if (contains(shape, x)) {
          ASSERT_TRUE(contactsOf({p}, x, reach).empty());
          continue;
        }
        const Nearest n = nearestOf(points, x);
        if (std::abs(n.distance - reach) < slack) continue;
        const std::vector<RegionContact> c = contactsOf({p}, x, reach);
        ASSERT_EQ(c.size(), n.distance < reach ? 1u : 0u)
            << "kind " << int(kind) << " seed " << seed << " distance " << n.distance << " reach " << reach;
        if (c.empty()) continue;
        ++touching;
        ASSERT_NEAR(norm(c[0].branch), n.distance, slack);
        ASSERT_LE(norm(c[0].branch), n.distance + 1e-12) << "there is a nearer point";
        ASSERT_EQ(c[0].number, 0);
      }
    }
    EXPECT_GT(touching, 100) << "kind " << int(kind);
  }
}

TEST(RegionShapes, FromInsideEachClosedFaceTouches)
{
  for (const RegionKind kind : {RegionKind::Block, RegionKind::Sphere, RegionKind::Cylinder, RegionKind::Cone}) {
    int several = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
      Dice dice(seed + 50);
      RegionPart p = randomShape(dice, kind);
      p.inside = true;
      std::vector<std::vector<Vec>> points;
      for (int face = 0; face < faceCount(kind); ++face) {
        p.openFace[static_cast<std::size_t>(face)] = kind != RegionKind::Sphere && seed > 1 && dice.coin(0.3);
        points.push_back(spread(p, face, fine));
      }
      const RegionShape shape = shapeOf(p);
      for (int k = 0; k < 400; ++k) {
        const Vec x = dice.point(1.6);
        const double reach = dice(0.2, 0.6);
        const std::vector<RegionContact> c = contactsOf({p}, x, reach);
        if (!contains(shape, x)) {
          ASSERT_TRUE(c.empty());
          continue;
        }
        several += c.size() > 1;
        for (int face = 0; face < faceCount(kind); ++face) {
          const auto found = std::find_if(c.begin(), c.end(), [&](const RegionContact &a) { return a.number == face; });
          const bool open = p.openFace[static_cast<std::size_t>(face)];
          const Nearest n = nearestOf(points[static_cast<std::size_t>(face)], x);
          // from beside an end of a cone its plane touches where the end is not any more
          if (kind == RegionKind::Cone && face < 2) {
            const double depth = std::abs(x[p.axis] - (face ? p.hi : p.lo)[static_cast<std::size_t>(p.axis)]);
            ASSERT_EQ(found != c.end(), !open && depth < reach);
            continue;
          }
          if (std::abs(n.distance - reach) < slack) continue;
          ASSERT_EQ(found != c.end(), !open && n.distance < reach) << "kind " << int(kind) << " face " << face;
          if (found == c.end()) continue;
          ASSERT_NEAR(norm(found->branch), n.distance, slack);
          ASSERT_LE(norm(found->branch), n.distance + 1e-12);
        }
      }
    }
    EXPECT_TRUE(several > 100 || kind == RegionKind::Sphere) << "kind " << int(kind);
  }
}

TEST(RegionShapes, PlanesAndPrisms)
{
  Dice dice(3);
  for (int k = 0; k < 2000; ++k) {
    RegionPart plane = randomShape(dice, RegionKind::Plane);
    const Vec x = dice.point(1.0);
    const double height = dot(x - toVec3(plane.centre), toVec3(plane.normal)), reach = 0.5;
    const std::vector<RegionContact> c = contactsOf({plane}, x, reach);
    ASSERT_EQ(c.size(), (height >= 0.0) == plane.inside && std::abs(height) < reach ? 1u : 0u);
    for (const RegionContact &a : c)
      ASSERT_TRUE(near(norm(a.branch - toVec3(plane.normal) * height), 0.0, roundOff(Precision::Double, 1.0)));

    // x = lo + u a + v b + w c with edges a, b and c: the depth under face w = 0 is w times the height of the prism
    RegionPart prism = randomShape(dice, RegionKind::Prism);
    prism.inside = true;
    const Vec lo = toVec3(prism.lo), hi = toVec3(prism.hi);
    const double u = dice(0, 1), v = dice(0, 1), w = dice(0, 1), lz = hi.z - lo.z;
    const Vec in{lo.x + u * (hi.x - lo.x) + v * prism.tilt[0] + w * prism.tilt[1],
                 lo.y + v * (hi.y - lo.y) + w * prism.tilt[2], lo.z + w * lz};
    const std::vector<RegionContact> p = contactsOf({prism}, in, reach);
    const auto floor = std::find_if(p.begin(), p.end(), [](const RegionContact &a) { return a.number == 0; });
    ASSERT_EQ(floor != p.end(), w * lz < reach);
    if (floor != p.end()) {
      ASSERT_TRUE(near(floor->branch.z, w * lz, roundOff(Precision::Double, 4)));
    }
    // the depth under face y-: the foot lies in the plane of a and c
    const auto side = std::find_if(p.begin(), p.end(), [](const RegionContact &a) { return a.number == 2; });
    const double depth = v * (hi.y - lo.y) * lz / std::hypot(lz, prism.tilt[2]);
    ASSERT_EQ(side != p.end(), depth < reach);
    if (side != p.end()) {
      ASSERT_TRUE(near(norm(side->branch), depth, roundOff(Precision::Double, 8)));
    }
  }
}

TEST(RegionShapes, CurvaturesEnterTheEffectiveRadius)
{
  RegionPart p;
  p.kind = RegionKind::Cylinder;
  p.radius = 2.0;
  p.lo = {0, 0, -5};
  p.hi = {0, 0, 5};
  EXPECT_EQ(contactsOf({p}, {1.7, 0, 0}, 0.5)[0].curvature, -4.0);
  p.inside = false;
  EXPECT_EQ(contactsOf({p}, {2.3, 0, 0}, 0.5)[0].curvature, 4.0);
  p.open = p.openFace[0] = true;
  EXPECT_EQ(contactsOf({p}, {2.3, 0, 0}, 0.5)[0].curvature, 4.0) << "an open end changes nothing at the curved face";
  EXPECT_EQ(contactsOf({p}, {1.9, 0, -5.2}, 0.5)[0].curvature, -4.0) << "the rim around a grain is hollow";
  p.kind = RegionKind::Cone;
  p.radiusHi = 2.0;
  EXPECT_EQ(contactsOf({p}, {2.3, 0, 0}, 0.5)[0].curvature, 4.0) << "a cone is not hollow from outside";
  p.kind = RegionKind::Sphere;
  p.open = false;
  EXPECT_EQ(contactsOf({p}, {2.3, 0, 0}, 0.5)[0].curvature, 2.0);
  p.inside = true;
  EXPECT_EQ(contactsOf({p}, {1.7, 0, 0}, 0.5)[0].curvature, -2.0);
  p.kind = RegionKind::Block;
  p.lo = {-2, -2, -2};
  p.hi = {2, 2, 2};
  EXPECT_EQ(contactsOf({p}, {1.7, 0, 0}, 0.5)[0].curvature, 0.0);
}

/// LAMMPS' recursion over unions and intersections, with flags that are turned and turned back.
class Recursion {
 public:
  explicit Recursion(std::vector<RegionPart> parts) : parts_(std::move(parts)) {}

  bool match(std::size_t k, const Vec &x) const
  {
    const RegionPart &p = parts_[k];
    return p.open || inside(k, x) == p.inside;
  }
  struct Found {
    Vec at;
    int number;
    bool shared;  ///< other faces may have the same number
  };
  std::vector<Found> contacts(std::size_t k, const Vec &x, double reach)
  {
    const RegionPart p = parts_[k];
    std::vector<Found> found;
    if (p.kind != RegionKind::Union && p.kind != RegionKind::Intersect) {
      SurfacePoint s[maxSurfacePoints];
      for (const bool fromInside : {false, true}) {
        if (!p.open && fromInside != p.inside) continue;
        const int n = surfacePoints(shapeOf(p), x, reach, fromInside, s);
        for (int i = 0; i < n; ++i) found.push_back({s[i].at, s[i].face, false});
      }
      return found;
    }
    const std::vector<std::size_t> members = membersOf(k);
    if (!p.inside)
      for (const std::size_t m : members) parts_[m].inside = !parts_[m].inside;
    const bool joins = (p.kind == RegionKind::Union) == p.inside;
    int offset = 0;
    for (std::size_t order = 0; order < members.size(); ++order) {
      for (const auto &[at, number, shared] : contacts(members[order], x, reach)) {
        bool counts = true;
        for (const std::size_t other : members)
          if (other != members[order] && !(joins && parts_[other].open)) counts = counts && match(other, at) != joins;
        if (!counts) continue;
        if (p.inside) found.push_back({at, offset + number, shared});
        else found.push_back({at, static_cast<int>(order), shared || number != 0});
      }
      offset += faces(members[order]);
    }
    if (!p.inside)
      for (const std::size_t m : members) parts_[m].inside = !parts_[m].inside;
    return found;
  }

 private:
  std::vector<std::size_t> membersOf(std::size_t k) const
  {
    std::vector<std::size_t> m;
    for (std::size_t c = k + 1; c < k + static_cast<std::size_t>(parts_[k].size);
         c += static_cast<std::size_t>(parts_[c].size))
      m.push_back(c);
    return m;
  }
  int faces(std::size_t k) const
  {
    const std::vector<std::size_t> m = membersOf(k);
    if (m.empty()) return faceCount(parts_[k].kind);
    int sum = 0;
    for (const std::size_t c : m) sum += faces(c);
    return sum;
  }
  bool inside(std::size_t k, const Vec &x) const
  {
    const RegionPart &p = parts_[k];
    const std::vector<std::size_t> m = membersOf(k);
    const auto has = [&](std::size_t c) { return match(c, x); };
    if (p.kind == RegionKind::Union) return std::any_of(m.begin(), m.end(), has);
    if (p.kind == RegionKind::Intersect) return std::all_of(m.begin(), m.end(), has);
    return contains(shapeOf(p), x);
  }
  std::vector<RegionPart> parts_;
};

void growTree(Dice &dice, std::vector<RegionPart> &parts, int depth)
{
  const std::size_t at = parts.size();
  if (depth == 0 || (parts.size() > 1 && dice.coin(0.3))) {
    RegionPart p = randomShape(dice, shapes[dice.pick(6)]);
    p.inside = dice.coin(0.7);
    if (dice.coin(0.2)) p.open = p.openFace[static_cast<std::size_t>(dice.pick(3))] = true;
    parts.push_back(p);
    return;
  }
  RegionPart whole;
  whole.kind = dice.coin() ? RegionKind::Union : RegionKind::Intersect;
  whole.inside = dice.coin(0.6);
  parts.push_back(whole);
  const int members = 2 + dice.pick(2);
  for (int m = 0; m < members; ++m) growTree(dice, parts, depth - 1);
  parts[at].size = static_cast<int>(parts.size() - at);
}

TEST(RegionTrees, FollowLammpsRules)
{
  int compared = 0, nested = 0, fromOutside = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    Dice dice(seed);
    std::vector<RegionPart> parts;
    growTree(dice, parts, 1 + static_cast<int>(seed % 3));
    if (parts.size() > maxRegionParts) continue;
    Recursion reference(parts);
    for (int k = 0; k < 500; ++k) {
      const Vec x = dice.point(1.8);
      std::vector<Recursion::Found> expected;
      if (reference.match(0, x)) expected = reference.contacts(0, x, 0.3);
      const std::vector<RegionContact> c = contactsOf(parts, x, 0.3);
      ASSERT_EQ(c.size(), std::min<std::size_t>(expected.size(), maxRegionContacts)) << "seed " << seed;
      for (std::size_t i = 0; i < c.size(); ++i) {
        ASSERT_EQ(c[i].number >= ownNumbers, expected[i].shared) << "seed " << seed;
        if (!expected[i].shared) {
          ASSERT_EQ(c[i].number, expected[i].number) << "seed " << seed;
        }
        ASSERT_TRUE(near(norm(x - c[i].branch - expected[i].at), 0.0, roundOff(Precision::Double, 4.0)));
        for (std::size_t j = 0; j < i; ++j) ASSERT_NE(c[i].number, c[j].number) << "two faces, one number";
      }
      compared += static_cast<int>(c.size());
      nested += seed % 3 == 2 ? static_cast<int>(c.size()) : 0;
      fromOutside += parts[0].inside ? 0 : static_cast<int>(c.size());
    }
  }
  EXPECT_GT(compared, 10000);
  EXPECT_GT(nested, 2000);
  EXPECT_GT(fromOutside, 1000);
}

/// The rows are rebuilt before a grain has moved farther than half the skin: a contact made until then must be
/// foreseen.
TEST(RegionTrees, NoContactIsNearerThanTheSurfaces)
{
  Dice dice(99);
  int contacts = 0;
  for (int k = 0; k < 12000; ++k) {
    std::vector<RegionPart> parts;
    growTree(dice, parts, 1);
    const std::vector<RegionShape> tree = regionShapes(parts);
    const Vec x = dice.point(1.8), moved = x + dice.point(0.3);
    for (const RegionContact &c : contactsOf(parts, moved, 0.4)) {
      ++contacts;
      ASSERT_LE(surfaceDistance(tree[static_cast<std::size_t>(c.part)], x), norm(c.branch) + norm(moved - x) + 1e-12);
    }
  }
  EXPECT_GT(contacts, 2000);
}

/// A region that is displaced and turned touches as the same region at rest does, seen from it.
TEST(RegionMotion, CarriesTheContacts)
{
  for (const RegionKind kind : shapes) {
    Dice dice(7);
    int contacts = 0;
    for (int k = 0; k < 500; ++k) {
      RegionPart part = randomShape(dice, kind), at = part;
      const Vec axis = dice.point(1.0);
      part.moves = part.rotates = true;
      part.pivot = array(dice.point(0.5));
      part.pivotAxis = array(axis * (1.0 / norm(axis)));
      PartMotion motion;
      motion.displacement = array(dice.point(0.4));
      motion.angle = dice(-3.0, 3.0);
      const RegionShape s = shapeOf(part);
      const PartState state = partState(motion);
      const Vec x = dice.point(1.8), seen = fromPart(s, state, x);
      ASSERT_TRUE(near(norm(toPart(s, state, seen) - x), 0.0, roundOff(Precision::Double, 4.0)));
      const std::vector<RegionContact> rest = contactsOf({at}, x, 0.5), moving = contactsOf({part}, seen, 0.5, {state});
      ASSERT_EQ(rest.size(), moving.size());
      for (std::size_t i = 0; i < rest.size(); ++i) {
        const Vec point = fromPart(s, state, x - rest[i].branch);
        ASSERT_TRUE(near(norm(seen - moving[i].branch - point), 0.0, roundOff(Precision::Double, 8.0)));
        ++contacts;
      }
    }
    EXPECT_GT(contacts, 40);
  }
}

TEST(RegionMotion, SurfaceVelocityIsTheRateOfItsPoints)
{
  Dice dice(8);
  for (int k = 0; k < 200; ++k) {
    RegionPart part = randomShape(dice, RegionKind::Block);
    part.moves = dice.coin();
    part.rotates = true;
    const Vec axis = dice.point(1.0);
    part.pivot = array(dice.point(0.5));
    part.pivotAxis = array(axis * (1.0 / norm(axis)));
    const std::vector<RegionShape> tree = regionShapes({part});
    const double dt = 1e-5;
    PartMotion motion, later;
    motion.displacement = array(dice.point(0.4));
    motion.velocity = array(dice.point(2.0));
    motion.angle = dice(-3.0, 3.0);
    motion.angularVelocity = dice(-2.0, 2.0);
    later = motion;
    for (std::size_t d = 0; d < 3; ++d) later.displacement[d] += dt * motion.velocity[d];
    later.angle += dt * motion.angularVelocity;
    const PartState state = partState(motion);
    const Vec own = dice.point(1.0), at = fromPart(tree[0], state, own);
    const Vec rate = (fromPart(tree[0], partState(later), own) - at) * (1.0 / dt);
    const Vec v = surfaceVelocity(RegionView{tree.data(), &state, 1}, 0, at);
    for (int d = 0; d < 3; ++d) ASSERT_NEAR(v[d], rate[d], 10.0 * dt);
  }
}

TEST(RegionMotion, SurfacesThatTurnInThemselvesStandStill)
{
  RegionPart drum;
  drum.kind = RegionKind::Cylinder;
  drum.axis = 1;
  drum.radius = 2.0;
  drum.centre = {1.0, 0.0, 3.0};
  drum.rotates = true;
  drum.pivot = {1.0, 7.0, 3.0};
  drum.pivotAxis = {0.0, 1.0, 0.0};
  EXPECT_FALSE(sweeps({shapeOf(drum)}));
  drum.pivot[0] = 1.001;
  EXPECT_TRUE(sweeps({shapeOf(drum)})) << "it wobbles";
  drum.pivot[0] = 1.0;
  drum.pivotAxis = {0.0, 0.6, 0.8};
  EXPECT_TRUE(sweeps({shapeOf(drum)}));
  drum.pivotAxis = {0.0, 1.0, 0.0};
  drum.moves = true;
  EXPECT_TRUE(sweeps({shapeOf(drum)}));

  RegionPart plate;
  plate.kind = RegionKind::Plane;
  plate.normal = {0.0, 0.6, -0.8};
  plate.rotates = true;
  plate.pivotAxis = {0.0, -0.6, 0.8};
  EXPECT_FALSE(sweeps({shapeOf(plate)}));
  plate.pivotAxis = {0.0, 0.8, 0.6};
  EXPECT_TRUE(sweeps({shapeOf(plate)}));
}

TEST(RegionTrees, WrongTreesAreRefused)
{
  RegionPart block, both;
  both.kind = RegionKind::Union;
  both.size = 3;
  EXPECT_NO_THROW(regionShapes({both, block, block}));
  EXPECT_THROW(regionShapes({}), Error);
  EXPECT_THROW(regionShapes({both, block}), Error);
  EXPECT_THROW(regionShapes({block, block}), Error);
  both.size = 1;
  EXPECT_THROW(regionShapes({both}), Error);
}

}  // namespace
