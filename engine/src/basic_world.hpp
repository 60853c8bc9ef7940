// SPDX-License-Identifier: Apache-2.0
#pragma once

// The world in one arithmetic. The loop is: take the earliest event, check that its partner has not
// changed since, resolve it, predict again for whoever changed.
//
// Who holds the prediction of a pair: the body that was predicted last, unless the other is dynamic
// and this one is not, or the other is more than four times smaller: then the other holds it. A
// wall or a large disk thus never scans its thousands of neighbours because one of them was hit.
//
// Invariants:
//  1. For every pair that can meet, the event of one of the two is at or before their contact. An
//     event whose partner has changed since is a lower bound and is predicted anew when it comes
//     up.
//  2. A prediction depends on the stored motions of the pair (and on walls that share the vertex).
//  3. Slots, boxes, lists and the queue never reach an output.

#include "bodies.hpp"
#include "body.hpp"
#include "broad_phase/neighbours.hpp"
#include "bytes.hpp"
#include "contact_law/elastic.hpp"
#include "contact_law/rough.hpp"
#include "contact_time/contact_time.hpp"
#include "contact_time/disk_wall.hpp"
#include "event_queue.hpp"
#include "id_ledger.hpp"
#include "laws.hpp"
#include "motion_law/drag.hpp"
#include "periodic.hpp"
#include "screen.hpp"
#include "sight.hpp"
#include "sight_frames.hpp"
#include "slot_table.hpp"
#include "world_core.hpp"
#include "zone_passages.hpp"

#include <stoss/engine/check.hpp>

#include <optional>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace stoss::engine {

/// The largest a disk may be, as a multiple of its partner, to hold their prediction.
inline constexpr int kHolderRatioMax = 4;
/// s; so soon at the latest the box of a body that moves is renewed, however slow it is: whoever
/// moves has an event, and can be found among those. Chosen: a quarter of all time.
inline constexpr double kLongestWait = 0x1p59;
/// This many collisions at one instant, and 64 a body, with no command in between, are no physics
/// but a packing without room: the world reports a stall and goes no further.
inline constexpr std::uint64_t kStallCollisions = 100'000;

template <class S, class Laws>
class BasicWorld final : public WorldCore {
 public:
  explicit BasicWorld(const WorldOptions& options);

  std::unique_ptr<WorldCore> clone() const override { return std::make_unique<BasicWorld>(*this); }

  Instant now() const override { return to_instant(now_); }
  Arithmetic arithmetic() const override { return arithmetic_; }
  BroadPhaseKind broad_phase() const override { return broad_phase_; }
  Effects effects() const override { return laws_.effects(); }
  Vector2 period() const override;
  std::size_t disk_count() const override { return slots_.size() - walls_in_use_ - zones_in_use_; }
  std::size_t wall_count() const override { return walls_in_use_; }
  std::size_t zone_count() const override { return zones_in_use_; }
  Counters counters() const override { return counters_; }
  Conserved conserved() const override;

  Outcome<std::vector<Id>> spawn(const SpawnRequest& request) override;
  Outcome<Done> remove(std::span<const Id> ids) override;
  Outcome<Done> set_velocity(std::span<const VectorFor> velocities) override;
  Outcome<Done> apply_impulse(std::span<const VectorFor> impulses) override;
  void nudge(std::uint64_t seed) override;
  Outcome<AdvanceReport> advance_to(const Instant& until,
                                    CollisionSink* sink,
                                    std::uint64_t max_events) override;

  bool contains(Id id) const override { return find_slot(id) >= 0; }
  Outcome<BodyState> state(Id id) const override;
  Outcome<WallState> wall(Id id) const override;
  void for_each_disk(const std::function<void(const BodyState&)>& visit) const override;
  void for_each_wall(const std::function<void(const WallState&)>& visit) const override;
  Outcome<ZoneState> zone(Id id) const override;
  void for_each_zone(const std::function<void(const ZoneState&)>& visit) const override;
  Outcome<std::vector<Id>> inside(Id zone) const override;
  std::vector<Id> region(const Vector2& low, const Vector2& high) const override;
  std::vector<Near> nearest(const Vector2& point, std::size_t count) const override;
  std::optional<RayHit> ray(const Vector2& origin,
                            const Vector2& direction,
                            double length_max) const override;

  Census census() const override;
  Outcome<MotionRecord> motion(Id id) const override;
  Outcome<BodyRecord> body(Id id) const override;
  std::vector<Id> ids() const override;
  std::vector<Change> drain_changes() override;

  std::vector<std::byte> serialise() const override;
  Outcome<Done> restore(std::span<const std::byte> bytes) override;
  Outcome<std::unique_ptr<WorldCore>> with_effects(const Effects& wanted) const override;
  std::uint64_t state_hash() const override;

 private:
  using Relative = typename Laws::template Relative<S>;
  using Radius = typename Laws::template Radius<S>;
  using Reach = typename Laws::template Reach<S>;
  using ConstBody = typename Bodies<S, Laws>::ConstView;
  using Seen = typename Bodies<S, Laws>::Seen;
  /// Which image of a body is meant; a plain world has no others, and nothing to say.
  using Which = std::conditional_t<Laws::kPlain, OneImage, Image>;

  /// A contact of two bodies as their motions foretell it. `a` is the disk of a disk and a wall, or
  /// the disk of lower id.
  struct Contact {
    Slot a = -1;
    Slot b = -1;
    EventKind kind = EventKind::DiskDisk;
    WallFeature feature = WallFeature::Face;
    Time<S> reference;  ///< the later of the two motions' instants
    Relative relative;  ///< disk-disk: b from a; else: disk from the wall's start or end
    Duration<S> after_reference{};        ///< s
    [[no_unique_address]] Which image{};  ///< of b, that a meets
  };

  /// The next crossing of a zone's rim by a disk.
  struct RimCrossing {
    Time<S> at;
    [[no_unique_address]] Which image{};  ///< of the zone, that the disk sees
  };

  /// What a contact does to its bodies.
  struct ContactOutcome {
    PairImpulse<S> impulse;
    SpinChange<S> spins;
    bool regularised = false;
    bool is_last_bounce = false;  ///< the disk stays on what it has met
  };

  /// Of a disk under the thermostat.
  struct Kicks {
    Time<S> next = Time<S>::never();
    std::uint64_t count = 0;  ///< had so far
  };

  struct Nothing {};
  using Common = std::conditional_t<Laws::kGrows, Growing, Steady>;
  /// The present as sights count it.
  struct SightClock {
    double now = 0;   ///< s after the epoch; under drag, as the clock runs that slows down with all
    double left = 1;  ///< how fast it still runs
    /// s from now on; what sights show of disks that are alike does not count any later
    double holds_for = std::numeric_limits<double>::infinity();
  };
  /// s; sooner, a guess would not be below the resolution of time.
  static constexpr double kNear = 1e-9;
  /// What a body has before it: bounds of the contacts that it holds, in seconds from now, and its
  /// first event of those that no sight shows.
  struct Foresight : SoonestTwo {
    std::optional<Event<S>> exact;
    const Event<S>* standing = nullptr;  ///< the guess that stood before, if any
    bool has_unseen = false;             ///< of some it is not known by sight when they come
  };

  /// Names the offending element of a command in a refusal.
  struct Place {
    const char* list;
    std::size_t index;
  };

  static std::size_t index(Slot slot) { return static_cast<std::size_t>(slot); }
  typename Bodies<S, Laws>::View at(Slot slot) { return bodies_.at(slot); }
  ConstBody at(Slot slot) const { return bodies_.at(slot); }
  WallShape<S>& shape(Slot slot) { return shapes_[static_cast<std::size_t>(at(slot).wall())]; }
  const WallShape<S>& shape(Slot slot) const {
    return shapes_[static_cast<std::size_t>(at(slot).wall())];
  }
  bool all_pairs() const { return broad_phase_ == BroadPhaseKind::AllPairs; }
  auto id_lookup() const;

  // basic_world_predict.hpp
  bool interacts(Slot a, Slot b) const;
  bool may_become_close(Slot a, const Aabb& box_of_a, Slot b) const;
  bool is_far_from_line(Slot wall, const Aabb& box) const;
  bool holds_prediction(Slot holder, Slot other) const;
  template <class Visit>
  void for_each_neighbour(Slot slot, Visit&& visit) const;
  Relative relative_motion(Slot of, Slot from, const Time<S>& reference, const Which& image) const;
  std::optional<Contact> contact_of(Slot i, Slot j) const;
  std::optional<Contact> contact_with(Slot a, Slot b, const Which& image) const;
  std::optional<Contact> disk_disk_contact_of(Slot a, Slot b, const Which& image) const;
  std::optional<Contact> disk_wall_contact_of(Slot disk, Slot wall, const Which& image) const;
  Relative motion_from_end(const Relative& from_start, Slot wall, int end) const;
  bool hidden_by_faces(const Relative& from_vertex,
                       Slot wall,
                       int end,
                       const Duration<S>& after,
                       bool has_left_face) const;
  DoubleWord2<S> edge_from(const WallEnd& vertex) const;
  std::optional<Event<S>> event_with(Slot holder, Slot partner) const;
  std::optional<Event<S>> event_of(const Contact& contact, Slot partner) const;
  Event<S> renewal_event(Slot slot, const Glance& here) const;
  double time_in_box(Slot slot, const Glance& here) const;
  double horizon_of(const Event<S>& event) const;
  bool may_meet(Slot slot, const Glance& here, Slot other, double horizon) const;
  bool may_meet_at(
      Slot slot, const Glance& here, Slot other, const Glance& there, double horizon) const;
  void predict(Slot slot, bool changed);
  void predict_both(Slot a, Slot b);
  void predict_closely(Slot slot, bool changed);
  void renew_box(Slot slot, double margin);
  bool cross(Slot slot);
  void bring_on(Slot slot, const Event<S>& renewal);
  void bring_stragglers_on();
  Aabb tight_box(Slot slot) const;
  Aabb tight_box(Slot slot, const Glance& here) const;
  double smallest_margin(Slot slot) const;
  double first_margin(Slot slot) const;

  // basic_world_sights.hpp
  bool has_sights() const;
  void foresee(Slot slot, bool changed);
  void foresee_both(Slot a, Slot b);
  double look_ahead(Slot slot, bool changed, const SightClock& clock, Foresight& ahead);
  bool foresee_newcomers(Slot slot, const Event<S>& crossing);
  void look_at_all(Slot slot,
                   std::span<const Slot> list,
                   double smallest,
                   const SightClock& clock,
                   Foresight& ahead) const;
  void look_at_listed(Slot slot,
                      std::span<const Slot> list,
                      bool changed,
                      const SightClock& clock,
                      double renewal,
                      Foresight& ahead);
  void prefetch_sights(Slot slot) const;
  void look_at_others(
      Slot slot, bool changed, const SightClock& clock, double renewal, Foresight& ahead);
  void look_at_unlike(Slot slot,
                      Slot other,
                      bool changed,
                      const SightClock& clock,
                      double renewal,
                      Foresight& ahead);
  bool see_each_other(Slot a, Slot b) const;
  Event<S> guess_of(const Foresight& ahead) const;
  void name_partner(Event<S>& event, Slot partner) const;
  Event<S> guess_after(double renewal, const Foresight& ahead) const;
  void set_guess(Slot slot, Event<S> next, double first, double second);
  void schedule(Slot slot, const Foresight& ahead, double renewal);
  double time_to_renewal(Slot slot, const Seen& own, const SightClock& clock) const;
  double time_to_renewal_far_out(Slot slot) const;
  Vector2 rough_place_of(Slot slot) const;
  void offer(Slot holder, Slot changed, double soonest);
  bool guess_again(Slot holder, Slot changed, double soonest);
  void join(Slot holder, Slot changed, float later);
  void sharpen(Slot slot);
  bool has_guess(Slot slot) const { return queue_.event_of(slot).kind == EventKind::Guess; }
  void renew_sight(Slot slot);
  bool falls_freely(Slot slot) const;
  Sight sight_of_falling(Slot slot) const;
  SightClock read_sight_clock() const;
  void begin_epoch();
  double seconds_of(double run, const SightClock& clock) const;
  Common common_to_sights(const SightClock& clock) const;
  SoonestTwo soonest_of(Slot slot,
                        std::span<const Slot> list,
                        double smallest,
                        const SightClock& clock) const;
  double soonest_seen(Slot a, Slot b, const SightClock& clock) const;
  double soonest_at_wall(Slot disk, Slot wall, const SightClock& clock) const;
  CommonPull common_pull() const;

  // basic_world_images.hpp
  bool is_periodic() const;
  template <class Visit>
  void for_each_image(Slot a, Slot b, Visit&& visit) const;
  template <class Visit>
  void for_each_neighbour_image(Slot slot, Visit&& visit) const;
  std::vector<Slot> found_around(Slot slot) const;
  void leave_lists(Slot slot);
  std::optional<Contact> first_contact_of(Slot a, Slot b) const;
  bool may_meet_some_image(Slot slot, const Glance& here, Slot other, double horizon) const;
  Vector2 normal_to_image(Slot disk, Slot wall, const Image& image) const;
  void renew_cage(Slot slot, Role role, double margin);
  double next_margin(Slot slot) const;
  Neighbours::Leeway leeway_of(Slot slot) const;
  bool has_small_cage(Slot slot) const;
  bool has_no_place(Slot slot) const;
  Vector2 shown(const DoubleWord2<S>& position) const;
  DoubleWord2<S> period_words() const;
  DoubleWord2<S> apart(const DoubleWord2<S>& p, const DoubleWord2<S>& q, const Which& image) const;
  DoubleWord2<S> nearest_apart(const DoubleWord2<S>& a, const DoubleWord2<S>& b) const;
  template <class Visit>
  void for_each_stored_copy(const Aabb& box, Visit&& visit) const;
  double speed_max() const;
  std::optional<Reject> check_room(const DiskSpec& spec, std::size_t i) const;
  std::optional<Reject> check_room(const WallSpec& spec, std::size_t i) const;
  std::optional<Reject> check_room(const ZoneSpec& spec, std::size_t i) const;
  static bool is_near(const Image& k);
  bool is_in_bounds(Slot slot) const;

  // basic_world_events.hpp
  void go_on_to(const Time<S>& instant);
  bool is_stale(const Event<S>& event) const;
  Slot next_slot();
  /// Bodies whose memory is no longer at hand, and those with which a second step of asking for it
  /// pays. Chosen.
  static constexpr std::size_t kAskAheadFrom = 4'000;
  static constexpr std::size_t kAskFurtherFrom = 20'000;
  bool is_worth_asking_ahead(std::size_t bodies_least) const;
  void prefetch_event(Slot slot) const;
  void prefetch_body(Slot slot) const;
  void prefetch_cells_of_second_event() const;
  void prefetch_cells(Slot slot) const;
  bool process(Slot slot, CollisionSink* sink);
  void resolve(const Contact& contact, const Time<S>& instant, CollisionSink* sink);
  bool is_squeezed(const Contact& contact) const;
  double hop(Slot slot, const Time<S>& from, const Time<S>& to) const;
  Vector2 normal_towards(Slot from, Slot to, const Which& image) const;
  bool depends_on_order(Slot shared, Slot other, const Which& image, const Vector2& normal) const;
  bool is_about_to_meet(Slot slot) const;
  bool is_simultaneous(const Contact& contact,
                       const Time<S>& before_a,
                       const Time<S>& before_b) const;
  DoubleWord2<S> contact_vector(const Contact& contact) const;
  void rebase(Slot slot, const Time<S>& instant);
  Collision describe(const Contact& contact,
                     const Time<S>& instant,
                     const ContactOutcome& outcome) const;
  void validate(std::uint64_t events) const;
  void count_towards_stall();
  bool has_stalled(const Time<S>& instant) const;

  // basic_world_laws.hpp
  DoubleWord2<S> position_of(Slot slot, const Time<S>& instant) const;
  DoubleWord2<S> velocity_of(Slot slot, const Time<S>& instant) const;
  Radius radius_of(Slot slot, const Time<S>& instant) const;
  double radius_now(Slot slot) const;
  double growth_of(Slot slot) const;
  Reach reach_between(Slot a, Slot b, const Time<S>& instant) const;
  auto radius_in_contact(Slot disk, const Time<S>& instant) const;
  Glance glance_of(Slot slot) const;
  double pull_of(Slot slot) const;
  double bend_of(Slot slot, const Glance& here) const;
  bool fly_straight(Slot a, Slot b) const;
  Flight<S> flight_of(Slot slot, const Time<S>& instant) const;
  DoubleWord2<S> wind_on(Slot slot) const;
  DoubleWord2<S> pull_towards(Slot support) const;
  S valid_for(Slot a, Slot b, const Time<S>& reference) const;
  void renew_law(Slot slot);
  void renew_acceleration(Slot slot);
  std::optional<Event<S>> own_event(Slot slot) const;
  std::optional<Event<S>> law_change(Slot slot) const;
  void process_own_event(Slot slot, const Time<S>& instant);
  double potential_energy(Slot slot) const;
  Rotation rotation_of(Slot slot) const;
  void set_rotation(Slot slot, const Rotation& rotation);
  void turn(Slot slot, const Time<S>& instant);
  ContactOutcome impulse_of(const Contact& contact, const Time<S>& instant) const;
  DoubleWord2<S> surface_velocity(const Contact& contact,
                                  const DoubleWord2<S>& normal,
                                  const DoubleWord2<S>& velocity) const;
  ContactOutcome lossy_impulse(const Contact& contact,
                               const DoubleWord2<S>& velocity,
                               const Time<S>& instant) const;
  bool collided_lately(ConstBody a, const Time<S>& instant, ConstBody b) const;
  void note_contact(Slot slot, const DoubleWord<S>& spin_change, const Time<S>& instant);
  bool order_matters_between(
      const Vector2& n1, const Vector2& n2, double w0, double w1, double w2) const;
  DoubleWord<S> twice_spin_energy(ConstBody body) const;
  template <class Sink>
  void write_body_part(Sink& sink, Slot slot, const Effects& kind) const;
  void read_body_part(ByteSource& source, Slot slot);

  // basic_world_zones.hpp
  bool is_zone(Slot slot) const;
  bool is_zone_and_disk(Slot a, Slot b) const;
  std::optional<Reject> check_zone(const ZoneSpec& spec, std::size_t i) const;
  Slot place(const ZoneSpec& spec);
  void find_who_is_inside(Slot slot);
  bool may_cross(
      Slot a, const Glance& here, Slot b, const Glance& there, double horizon, double bend) const;
  std::optional<RimCrossing> crossing_of(Slot disk, Slot zone) const;
  std::optional<Event<S>> zone_event_of(Slot disk, Slot zone) const;
  void process_crossing(Slot disk, const Event<S>& event, CollisionSink* sink);
  Event<S> next_but_for_zones(Slot disk) const;
  void begin_motion(Slot slot, const Time<S>& instant);
  void forget_passages(Slot slot);
  ZoneState zone_of(Slot slot) const;
  std::size_t passage_count(Slot slot) const;
  template <class Sink>
  void write_passages(Sink& sink, Slot slot) const;
  bool read_passages(ByteSource& source, Slot slot, std::uint64_t count);
  bool has_sound_passages(Slot slot) const;

  // basic_world_rest.hpp
  /// What holds a disk besides the body that it has just met; kNoId where that one is enough.
  struct Hold {
    Id id = kNoId;
    [[no_unique_address]] Which image{};
  };
  bool rests_on(Slot a, Slot b, const Which& image) const;
  bool is_held_by(Slot disk, Slot support) const;
  RestImages rest_images(Slot disk) const;
  void set_rest_images(Slot disk, const RestImages& images);
  void let_go(Slot slot);
  bool is_last_bounce(const Contact& contact,
                      const PairImpulse<S>& elastic,
                      const S& restitution) const;
  S hop_speed(const Contact& contact, const PairImpulse<S>& elastic, const S& restitution) const;
  std::optional<Hold> finds_hold(const Contact& contact) const;
  void settle_down(const Contact& contact);
  void renew_rest(Slot slot);
  bool has_sound_supports(Slot slot) const;
  std::vector<Slot> wake_disks_on(Slot support);

  // basic_world_thermostat.hpp
  Kicks first_kick(Slot slot, const Thermostat& thermostat) const;
  Time<S> next_kick(Slot slot,
                    const Thermostat& thermostat,
                    std::uint64_t number,
                    const Time<S>& from) const;
  void start_kicks(Slot slot);
  std::optional<Event<S>> kick_event(Slot slot) const;
  void kick(Slot slot, const Time<S>& instant);
  template <class Sink>
  void write_kicks(Sink& sink, Slot slot, const Thermostat& thermostat) const;
  void read_kicks(ByteSource& source, Slot slot);
  bool has_sound_kicks(Slot slot) const;

  // basic_world_commands.hpp
  std::optional<Reject> check_disk(const DiskSpec& spec, std::size_t i) const;
  std::optional<Reject> check_wall(const WallSpec& spec, std::size_t i) const;
  std::optional<Reject> check_new_ids(const SpawnRequest& request) const;
  std::optional<Reject> check_request(const SpawnRequest& request) const;
  std::optional<Reject> check_targets(std::span<const VectorFor> targets, const char* list) const;
  std::optional<Reject> check_distinct(std::vector<Id> ids, const char* list) const;
  Slot place(const DiskSpec& spec);
  Slot place(const WallSpec& spec);
  Slot take_slot(Id id, BodyType type);
  void make_room(std::size_t count);
  void release(Slot slot);
  std::optional<Reject> overlap_of(Slot slot, const Place& place) const;
  bool is_clearly_apart(Slot slot, const Glance& here, Slot other) const;
  Reject in_asked_ids(Reject overlap,
                      const SpawnRequest& request,
                      const std::vector<Id>& made) const;
  double clearance(Slot a, Slot b, const Which& image) const;
  double reach_of(Slot a, Slot b) const;
  void enter(Slot slot);
  void link_vertices(Slot wall);
  void unlink_vertices(Slot wall);
  void predict_around(Slot wall);
  void lay_bare(Slot wall);
  bool same_vertex(const WallEnd& a, const WallEnd& b) const;
  void note_change(Slot slot, ChangeKind kind) {
    if constexpr (!Laws::kPlain) {
      if (is_zone(slot)) return;
    }
    changes_.note(at(slot).id, kind);
  }

  // basic_world_queries.hpp
  auto id_of_slot() const {
    return [this](Slot slot) { return at(slot).id; };
  }
  /// Below 0 if there is none.
  Slot find_slot(Id id) const { return slots_.find(id, id_of_slot()); }
  /// REQUIRES: there is one.
  Slot slot_of(Id id) const {
    const Slot slot = find_slot(id);
    check(slot >= 0, "a body is named that is not there");
    return slot;
  }
  Reject not_found(Id id) const;
  const std::vector<Slot>& ordered_slots() const;
  BodyState state_of(Slot slot) const;
  WallState wall_of(Slot slot) const;
  bool touches(Slot slot, const Vector2& low, const Vector2& high) const;
  bool some_image_touches(Slot slot, const Aabb& box) const;
  double distance_to_nearest_image(Slot slot, const Vector2& point) const;
  std::optional<RayHit> ray_among_images(const Vector2& origin,
                                         const Vector2& unit,
                                         double length_max) const;
  Aabb shown_box(Slot slot) const;
  double distance_to(Slot slot, const Vector2& point) const;
  std::optional<RayHit> ray_meets(Slot slot, const Vector2& origin, const Vector2& unit) const;

  // basic_world_census.hpp
  Aabb swept_box(Slot slot) const;
  Aabb swept_box(Slot slot, const Aabb& end) const;
  void examine(Slot a, Slot b, const Which& image, Census& census) const;
  Census census_of_images() const;

  // basic_world_switch.hpp
  bool law_differs(Slot slot, const Effects& wanted) const;
  Kicks kicks_under(Slot slot, const Thermostat& wanted) const;

  // basic_world_bytes.hpp
  std::vector<std::byte> bytes_for(const Effects& kind) const;
  template <class Sink>
  void write_body(Sink& sink, Slot slot, const Effects& kind) const;
  void note_digest_stale(Slot slot);
  void note_fresh_digest_stale(Slot slot);
  std::uint64_t digest_of(Slot slot, const Effects& kind) const;
  const char* read_bodies(ByteSource& source);
  void read_body(ByteSource& source, Id id, BodyType type);
  bool is_sound(Slot slot) const;
  void settle();

  Time<S> now_;
  Arithmetic arithmetic_;
  BroadPhaseKind broad_phase_;
  [[no_unique_address]] typename Laws::template Settings<S> laws_;
  [[no_unique_address]] std::conditional_t<Laws::kPlain, OpenSpace, PeriodicSpace<S>> space_;
  Counters counters_;
  Id next_id_ = 1;
  IdLedger ledger_;

  Bodies<S, Laws> bodies_;
  std::vector<WallShape<S>> shapes_;
  std::vector<Slot> free_slots_;
  std::vector<std::int32_t> free_shapes_;
  SlotTable slots_;
  /// Of turning disks in a plain world; looked up, never iterated.
  std::unordered_map<Slot, Rotation> rotations_;
  // By slot; empty without a thermostat.
  [[no_unique_address]] std::conditional_t<Laws::kPlain, Nothing, std::vector<Kicks>> kicks_;
  std::size_t walls_in_use_ = 0;
  std::size_t zones_in_use_ = 0;
  [[no_unique_address]] std::conditional_t<Laws::kPlain, NoZonePassages, ZonePassages<S>> passages_;

  /// What all sights have in common.
  struct Sights {
    Epoch<S> epoch;
    std::uint64_t uses = 0;                  ///< in this epoch
    mutable std::vector<PassedOver> others;  ///< of those that were looked at last
  };
  Sights sights_;

  Neighbours neighbours_;
  EventQueue<S> queue_;
  Time<S> crowded_instant_ = Time<S>::never();  ///< of the last collision
  std::uint64_t crowd_ = 0;                     ///< collisions at that instant since a command
  Contact due_{};                               ///< of the event that was sharpened last
  Slot due_slot_ = -1;                          ///< whose that is, until an event is processed

  // The bodies' digests, brought up to date for those that changed when the hash is asked for.
  // Nothing is kept until it was asked for once.
  struct Digests {
    bool is_kept = false;
    std::vector<std::uint64_t> of_slot;
    std::vector<std::uint8_t> is_stale;  // not bits: noted twice a collision
    std::vector<Slot> stale;
    std::uint64_t sum = 0;
  };
  mutable Digests digests_;

  mutable std::vector<Slot> ordered_;
  mutable bool ordered_valid_ = true;
};

template <class S, class Laws>
BasicWorld<S, Laws>::BasicWorld(const WorldOptions& options)
    : now_(from_instant<Time<S>>(options.start)),
      arithmetic_(options.arithmetic),
      broad_phase_(options.broad_phase),
      laws_(options.effects),
      space_(options.period) {
  sights_.epoch.start(now_);
}

}  // namespace stoss::engine

#include "basic_world_bytes.hpp"
#include "basic_world_commands.hpp"
#include "basic_world_queries.hpp"
// After the queries, whose evaluations they use.
#include "basic_world_census.hpp"
#include "basic_world_events.hpp"
#include "basic_world_images.hpp"
#include "basic_world_laws.hpp"
#include "basic_world_predict.hpp"
#include "basic_world_rest.hpp"
#include "basic_world_sights.hpp"
#include "basic_world_switch.hpp"
#include "basic_world_thermostat.hpp"
#include "basic_world_zones.hpp"
