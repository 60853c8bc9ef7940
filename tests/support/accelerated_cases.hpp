// SPDX-License-Identifier: Apache-2.0
// Contacts under constant relative acceleration: the exact answers to 400 bits, and seeded families
// of cases that are each hard in one way. A case is built backwards from its contact to 400 bits
// and then rounded to one or two words; the rounded words are the case. Trusted because the oracle
// knows nothing of vectors: it isolates the roots of the expanded polynomial between the roots of
// its derivative, down to the quadratic, with 240 bits to spare.
#pragma once

#include "contact_time/accelerated.hpp"
#include "support/contact_cases.hpp"
#include "support/oracle.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace stoss::test {

/// Coefficients, the constant first.
using Polynomial = std::vector<Real>;

inline Real value_of(const Polynomial& f, const Real& t) {
  Real sum = 0;
  for (std::size_t i = f.size(); i-- > 0;) sum = Real(sum * t + f[i]);
  return sum;
}

inline Polynomial derivative_of(const Polynomial& f) {
  Polynomial result;
  for (std::size_t i = 1; i < f.size(); ++i) result.push_back(Real(f[i] * static_cast<double>(i)));
  return result;
}

/// The root of a quadratic between two points, by the formula; none if it is not there.
inline std::optional<Real> quadratic_root(const Polynomial& f, const Real& low, const Real& high) {
  const Real d = f[1] * f[1] - 4 * f[0] * f[2];
  if (f[2] == 0 || d <= 0) return std::nullopt;
  const Real q = (f[1] < 0 ? Real(sqrt(d) - f[1]) : Real(-f[1] - sqrt(d))) / 2;
  for (const Real& t : {Real(q / f[2]), Real(f[0] / q)}) {
    if (t > low && t < high) return t;
  }
  return std::nullopt;
}

/// The root between two points where f has different signs.
inline Real root_in_bracket(const Polynomial& f, const Polynomial& slope, Real low, Real high) {
  if (f.size() == 3) {
    if (const auto t = quadratic_root(f, low, high)) return *t;
  }
  const bool rising = value_of(f, high) > 0;
  const Real close = ldexp(Real(1), -390);
  Real t = (low + high) / 2;
  for (int i = 0; i < 3000; ++i) {
    const Real value = value_of(f, t);
    if (value == 0) return t;
    ((value > 0) == rising ? high : low) = t;
    const Real steepness = value_of(slope, t);
    const Real step = steepness == 0 ? Real(0) : Real(-value / steepness);
    Real next = t + step;
    if (steepness != 0 && abs(step) <= close * abs(t)) return next;
    // Brackets over many decades are halved in their exponents.
    if (!(next > low && next < high)) {
      const bool decades = low > 0 && high > 4 * low;
      next = decades ? Real(sqrt(low * high)) : Real((low + high) / 2);
    }
    if (high - low <= close * high) return next;
    t = next;
  }
  return t;
}

/// The polynomial without leading coefficients of zero: a straight flight's gap is a quadratic.
inline Polynomial trimmed(Polynomial f) {
  while (f.size() > 1 && f.back() == 0) f.pop_back();
  return f;
}

/// The places in (0, end) where f changes sign, in order.
inline std::vector<Real> sign_changes(const Polynomial& given, const Real& end) {
  const Polynomial f = trimmed(given);
  if (f.size() < 2) return {};
  const Polynomial slope = derivative_of(f);
  std::vector<Real> points{Real(0)};
  for (const Real& t : sign_changes(slope, end)) points.push_back(t);
  points.push_back(end);
  std::vector<Real> roots;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Real left = value_of(f, points[i]), right = value_of(f, points[i + 1]);
    if ((left < 0 && right > 0) || (left > 0 && right < 0)) {
      roots.push_back(root_in_bracket(f, slope, points[i], points[i + 1]));
    } else if (right == 0 && i + 2 < points.size() && left != 0) {
      const Real beyond = value_of(f, points[i + 2]);
      if ((left < 0) != (beyond < 0)) roots.push_back(points[i + 1]);
    }
  }
  return roots;
}

/// A bound of all roots (Cauchy's).
inline Real root_bound(const Polynomial& given) {
  const Polynomial f = trimmed(given);
  Real bound = 0;
  for (std::size_t i = 0; i + 1 < f.size(); ++i) {
    // Fujiwara's: 2 max |f_i / f_n|^(1 / (n - i)), the root taken of a power of two above.
    if (f[i] == 0) continue;
    int exponent = 0;
    frexp(Real(f[i] / f.back()), &exponent);
    const auto degree = static_cast<int>(f.size() - 1 - i);
    const int share = exponent > 0 ? (exponent + degree - 1) / degree : exponent / degree;
    bound = std::max(bound, Real(ldexp(Real(1), share + 2)));
  }
  return bound;
}

/// The infimum of the t >= 0 with f(t) <= 0 and falling.
inline std::optional<Real> exact_fall(const Polynomial& given) {
  const Polynomial f = trimmed(given);
  const Polynomial slope = derivative_of(f);
  std::vector<Real> points{Real(0)};
  const Real end = std::max(root_bound(f), root_bound(slope)) + 1;
  for (const Real& t : sign_changes(slope, end)) points.push_back(t);
  points.push_back(end);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Real middle = i + 2 < points.size() || i == 0 ? Real((points[i] + points[i + 1]) / 2)
                                                        : Real(points[i] * 2 + 1);
    if (value_of(slope, middle) >= 0) continue;  // this piece rises
    const Real left = value_of(f, points[i]);
    if (left <= 0) return points[i];
    if (value_of(f, points[i + 1]) < 0) return root_in_bracket(f, slope, points[i], points[i + 1]);
  }
  return std::nullopt;
}

/// |p + v t + a t^2 / 2|^2 - d^2
inline Polynomial gap_polynomial(const Real2& p, const Real2& v, const Real2& a, const Real& d) {
  return {Real(dot(p, p) - d * d),
          Real(2 * dot(p, v)),
          Real(dot(v, v) + dot(p, a)),
          dot(v, a),
          Real(dot(a, a) / 4)};
}

template <class S>
struct CurvedCase {
  engine::AcceleratedMotion<S> motion;
  engine::DoubleWord<S> reach;
  S t_max = std::numeric_limits<S>::infinity();
};

template <class S>
std::optional<Real> exact_contact(const CurvedCase<S>& c) {
  const std::optional<Real> t = exact_fall(gap_polynomial(exact(c.motion.position),
                                                          exact(c.motion.velocity),
                                                          exact(c.motion.acceleration),
                                                          exact(c.reach)));
  if (!t || (engine::detail::is_finite(c.t_max) && *t > Real(c.t_max))) return std::nullopt;
  return t;
}

/// A parabola by its contact: after `t` seconds, at `1 + above` reaches, with the given speed,
/// whose direction has the sines `inward` (towards the centre) against the tangent. The
/// acceleration has the angle `turn` against the inward normal.
struct CurvedShape {
  Real t = 1;
  Real above = 0;
  Real inward = 1;
  double speed = 1;
  double pull = 1;
  double turn = 0;
  double reach = 1;
  double t_max = std::numeric_limits<double>::infinity();
  bool level = false;  ///< acceleration along -y exactly, as gravity
};

struct CurvedFamily {
  std::string name;
  std::function<CurvedShape(Random&)> shape;
};

template <class S>
CurvedCase<S> make_curved(const CurvedShape& shape, Random& random, bool low_words) {
  const double half_turn = std::numbers::pi / 2;
  const double angle = shape.level ? half_turn : random.uniform(0, 4 * half_turn);
  const Real2 up{std::cos(angle), std::sin(angle)};
  const Real2 across{-up.y, up.x};
  const double side = random.either_sign(1);
  const Real slide = sqrt(Real(1) - shape.inward * shape.inward) * side * shape.speed;
  const Real close = shape.inward * shape.speed;
  const Real2 u{slide * across.x - close * up.x, slide * across.y - close * up.y};
  const Real down(shape.pull * std::cos(shape.turn)), aside(shape.pull * std::sin(shape.turn));
  const Real2 pull{aside * across.x - down * up.x, aside * across.y - down * up.y};
  CurvedCase<S> c;
  c.reach = rounded<S>(Real(shape.reach), low_words);
  c.t_max = static_cast<S>(shape.t_max);
  c.motion.acceleration = rounded<S>(pull, low_words);
  const Real2 a = exact(c.motion.acceleration);
  c.motion.velocity = rounded<S>(Real2{u.x - a.x * shape.t, u.y - a.y * shape.t}, low_words);
  const Real2 v = exact(c.motion.velocity);
  const Real height = exact(c.reach) * (1 + shape.above);
  const Real t = shape.t, t2 = t * t / 2;
  c.motion.position = rounded<S>(Real2{up.x * height - v.x * t - a.x * t2,  //
                                       up.y * height - v.y * t - a.y * t2},
                                 low_words);
  return c;
}

inline CurvedShape generic_curve(Random& r) {
  CurvedShape s;
  s.t = r.uniform(0.05, 4);
  s.inward = r.uniform(0, 1);
  s.speed = r.uniform(0.1, 5);
  s.pull = r.uniform(0.1, 10);
  s.turn = r.uniform(0, 2 * std::numbers::pi);
  s.reach = r.uniform(0.5, 2);
  return s;
}

/// Parabolas that start near contact, or graze.
inline std::vector<CurvedFamily> curves_near_contact(const Decades& decades) {
  const double finest = decades.finest;
  const double full = 2 * std::numbers::pi;
  std::vector<CurvedFamily> families;
  families.push_back({"generic", generic_curve});
  families.push_back({"until t_max", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.t_max = s.t.convert_to<double>() * r.uniform(0.5, 1.5);
                        return s;
                      }});
  families.push_back({"near touching", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.t = r.decades(finest, 0);
                        return s;
                      }});
  families.push_back({"near touching and grazing", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.inward = r.decades(finest / 2, 0);
                        s.t = r.decades(finest, 0);
                        return s;
                      }});
  families.push_back({"grazing hit", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.inward = 0;
                        s.above = -Real(r.decades(finest, -1));
                        return s;
                      }});
  families.push_back({"grazing miss", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.inward = 0;
                        s.above = Real(r.decades(finest, -1));
                        return s;
                      }});
  families.push_back({"apex below a disk", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.inward = 0;
                        s.speed = r.decades(-4, 0);
                        s.turn = full / 2 + r.either_sign(r.decades(-8, 0));
                        s.above = Real(r.either_sign(r.decades(finest, -1)));
                        return s;
                      }});
  return families;
}

/// Parabolas that are far, touch again, or hardly bend.
inline std::vector<CurvedFamily> curves_of_all_sizes(const Decades& decades) {
  const double finest = decades.finest;
  const double far = decades.far;
  const double full = 2 * std::numbers::pi;
  std::vector<CurvedFamily> families;
  families.push_back({"far bullets", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.t = r.decades(0, far);
                        s.pull = s.speed / s.t.convert_to<double>() * r.uniform(0.01, 1);
                        s.turn = r.uniform(-full / 8, full / 8);
                        return s;
                      }});
  families.push_back({"overlap, approaching", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.t = 0;
                        s.above = -Real(r.decades(finest, finest / 2));
                        return s;
                      }});
  families.push_back({"contact that comes again", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.t = 0;
                        s.above = Real(r.either_sign(r.decades(finest, finest / 2)));
                        s.inward = -Real(r.decades(finest / 2, 0));
                        s.speed = r.decades(finest / 2, 0);
                        s.turn = r.uniform(-full / 4, full / 4);
                        return s;
                      }});
  families.push_back({"drop on a corner", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.level = true;
                        s.turn = 0;
                        s.inward = 1;
                        s.above = Real(r.uniform(0, 3)), s.t = 0, s.speed = r.uniform(-3, 3);
                        return s;
                      }});
  families.push_back({"tiny acceleration", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.pull = s.speed / s.t.convert_to<double>() * r.decades(finest, -3);
                        s.above = r.uniform(-1, 1) < 0 ? Real(0) : -Real(r.decades(finest, 0));
                        s.t_max = s.t.convert_to<double>() * 10;
                        return s;
                      }});
  families.push_back({"no acceleration", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        s.pull = 0;
                        return s;
                      }});
  families.push_back({"all mixed", [=](Random& r) {
                        CurvedShape s = generic_curve(r);
                        const double size = r.decades(-decades.sizes, decades.sizes);
                        const double rate = r.decades(-decades.sizes / 2, decades.sizes / 2);
                        s.inward = r.decades(finest / 2, 0);
                        s.above = Real(r.either_sign(r.decades(finest, -1)));
                        s.t = s.t * r.decades(finest / 2, 1) / rate;
                        s.reach *= size;
                        s.speed *= size * rate;
                        s.pull *= size * rate * rate * r.decades(-3, 1);
                        return s;
                      }});
  return families;
}

/// The families of parabolas for a scalar with these decades.
inline std::vector<CurvedFamily> curved_families(const Decades& decades) {
  std::vector<CurvedFamily> all;
  for (const auto& part : {curves_near_contact(decades), curves_of_all_sizes(decades)}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

template <class S>
struct FacedCase {
  engine::AcceleratedMotion<S> motion;  ///< of the disk's centre from the wall's start
  engine::DoubleWord2<S> edge;
  S radius{};
  S t_max = std::numeric_limits<S>::infinity();
};

struct ExactLanding {
  std::optional<Real> t;
  bool is_at_an_end = false;  ///< so near to an end that the face may leave it to the end's circle
};

/// The first contact with either face within the segment.
template <class S>
ExactLanding exact_landing(const FacedCase<S>& c) {
  const Real2 p = exact(c.motion.position), v = exact(c.motion.velocity);
  const Real2 a = exact(c.motion.acceleration), e = exact(c.edge);
  const Real reach = Real(c.radius) * sqrt(dot(e, e));
  const int side = cross(e, p) < 0 ? -1 : 1;
  const Real h = cross(e, p) * side, w = cross(e, v) * side, k = cross(e, a) * side;
  std::vector<Real> landings;
  if (const auto t = exact_fall({Real(h - reach), w, Real(k / 2)})) landings.push_back(*t);
  const Polynomial below{Real(-h - reach), Real(-w), Real(-k / 2)};
  const std::vector<Real> sides = sign_changes(below, Real(root_bound(below) + 1));
  if (sides.size() == 2) landings.push_back(sides[1]);
  for (const Real& t : landings) {
    const Real along = dot(e, p) + t * (dot(e, v) + t * dot(e, a) / 2);
    const Real terms = abs(dot(e, p)) + t * (abs(dot(e, v)) + t * abs(dot(e, a)) / 2) + dot(e, e);
    const Real margin = 4096 * Real(std::numeric_limits<S>::epsilon()) * terms;
    if (abs(along) < margin || abs(along - dot(e, e)) < margin) return {std::nullopt, true};
    if (along < 0 || along > dot(e, e)) continue;
    if (engine::detail::is_finite(c.t_max) && t > Real(c.t_max)) return {};
    return {t, false};
  }
  return {};
}

/// A parabola by its contact with a wall's line: after `t` seconds, at `place` along the wall and
/// `above` metres above contact, closing at `close` metres per second.
struct FacedShape {
  Real t = 1;
  Real above = 0;
  double place = 0.5;
  double close = 1;
  double slide = 0;
  double down = 1;   ///< acceleration towards the wall
  double along = 0;  ///< acceleration along the wall
  double length = 4;
  double radius = 0.5;
  double t_max = std::numeric_limits<double>::infinity();
};

struct FacedFamily {
  std::string name;
  std::function<FacedShape(Random&)> shape;
};

template <class S>
FacedCase<S> make_faced(const FacedShape& shape, Random& random, bool low_words) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  FacedCase<S> c;
  c.edge = rounded<S>(
      Real2{Real(shape.length) * std::cos(angle), Real(shape.length) * std::sin(angle)}, low_words);
  c.radius = static_cast<S>(shape.radius);
  c.t_max = static_cast<S>(shape.t_max);
  const Real2 edge = exact(c.edge);
  const Real length = sqrt(dot(edge, edge));
  const Real2 along{edge.x / length, edge.y / length};
  const double side = random.either_sign(1);
  const Real2 up{-along.y * side, along.x * side};
  const auto mix = [&](const Real& x, const Real& y) {
    return Real2{x * along.x + y * up.x, x * along.y + y * up.y};
  };
  c.motion.acceleration = rounded<S>(mix(Real(shape.along), Real(-shape.down)), low_words);
  const Real2 a = exact(c.motion.acceleration), u = mix(Real(shape.slide), Real(-shape.close));
  c.motion.velocity = rounded<S>(Real2{u.x - a.x * shape.t, u.y - a.y * shape.t}, low_words);
  const Real2 v = exact(c.motion.velocity);
  const Real2 at = mix(length * shape.place, Real(c.radius) + shape.above);
  const Real t = shape.t, t2 = t * t / 2;
  c.motion.position =
      rounded<S>(Real2{at.x - v.x * t - a.x * t2, at.y - v.y * t - a.y * t2}, low_words);
  return c;
}

inline FacedShape generic_landing(Random& r) {
  FacedShape s;
  s.t = r.uniform(0.05, 4);
  s.place = r.uniform(-0.2, 1.2);
  s.close = r.uniform(0, 5);
  s.slide = r.uniform(-5, 5);
  s.down = r.uniform(-10, 10);
  s.along = r.uniform(-10, 10);
  s.length = r.uniform(1, 10);
  s.radius = r.uniform(0.1, 2);
  return s;
}

/// Landings near contact, or at an apex.
inline std::vector<FacedFamily> landings_near_contact(const Decades& decades) {
  const double finest = decades.finest;
  std::vector<FacedFamily> families;
  families.push_back({"generic", generic_landing});
  families.push_back({"until t_max", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.t_max = s.t.convert_to<double>() * r.uniform(0.5, 1.5);
                        return s;
                      }});
  families.push_back({"tiny gap", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.t = r.decades(finest, 0);
                        return s;
                      }});
  families.push_back({"fast, faint acceleration", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.down *= r.decades(finest, 0);
                        s.along *= r.decades(finest, 0);
                        s.t_max = s.t.convert_to<double>() * 10;
                        return s;
                      }});
  families.push_back({"apex at a ceiling", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.close = 0;
                        s.down = -r.uniform(0.1, 10);
                        s.above = Real(r.either_sign(r.decades(finest, -1)));
                        return s;
                      }});
  families.push_back({"apex at a ceiling, touching", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.close = 0;
                        s.down = -r.uniform(0.1, 10);
                        s.t = r.decades(finest / 2, 0);
                        s.above = -s.t * s.t * Real(r.decades(finest / 2, 0));
                        return s;
                      }});
  return families;
}

/// Landings past an end, again, and from afar.
inline std::vector<FacedFamily> landings_of_all_sizes(const Decades& decades) {
  const double finest = decades.finest;
  const double far = decades.far;
  std::vector<FacedFamily> families;
  families.push_back({"past an end, from below", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.down = r.uniform(3, 10);
                        s.close = r.uniform(0.5, 2);
                        s.t = r.uniform(2, 4);
                        return s;
                      }});
  families.push_back({"overlap, approaching", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.t = 0;
                        s.above = -Real(r.decades(finest, finest / 2));
                        s.close = r.decades(-3, 0);
                        return s;
                      }});
  families.push_back({"bounce that comes down again", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.t = 0;
                        s.above = Real(r.either_sign(r.decades(finest, finest / 2)));
                        s.close = -r.decades(finest / 2, 0);
                        s.down = r.uniform(0.1, 10);
                        return s;
                      }});
  families.push_back({"far flights", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        s.t = r.decades(0, far);
                        s.close += 0.1;
                        const double share = s.close / s.t.convert_to<double>();
                        s.down = share * r.uniform(0, 1);
                        s.along = share * r.uniform(-1, 1);
                        s.place = r.uniform(0.01, 0.99);
                        return s;
                      }});
  families.push_back({"all mixed", [=](Random& r) {
                        FacedShape s = generic_landing(r);
                        const double size = r.decades(-decades.sizes, decades.sizes);
                        const double rate = r.decades(-decades.sizes / 2, decades.sizes / 2);
                        s.t = s.t * r.decades(finest / 2, 1) / rate;
                        s.above = Real(r.either_sign(r.decades(finest, -1)) * size);
                        s.length *= size * r.decades(0, 2);
                        s.radius *= size;
                        s.close *= size * rate * r.decades(finest / 2, 0);
                        s.slide *= size * rate;
                        s.down *= size * rate * rate;
                        s.along *= size * rate * rate;
                        return s;
                      }});
  return families;
}

/// The families of parabolas and walls for a scalar with these decades.
inline std::vector<FacedFamily> faced_families(const Decades& decades) {
  std::vector<FacedFamily> all;
  for (const auto& part : {landings_near_contact(decades), landings_of_all_sizes(decades)}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace stoss::test
