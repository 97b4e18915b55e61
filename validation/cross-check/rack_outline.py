"""How far points of a gear's outline lie from what a basic rack leaves of it, from the rack alone.

A rack tooth rolls through the gear's space and takes away whatever it covers: what stands is as far from it as the least
distance at any moment of the roll. Neither involute nor trochoid, nor where they meet, is known here: undercut comes
about by itself. The distance is exact outside of the rack, and inside it as deep as the rack's tip rounding.

A point is given by its radius and its angle from the middle of the space; the rack has profile shift 0.
"""

import math
from dataclasses import dataclass

# The rack is followed this many modules either way, at this many places before the least distance is searched between them.
REACH_MODULES, PLACES = 4.0, 161
GOLDEN = 0.5 * (math.sqrt(5.0) - 1.0)


@dataclass
class Rack:
    """The cutting rack's tooth: across from its middle, up from the datum line, the tip below at −dedendum."""

    module_mm: float
    pressure_angle_rad: float
    dedendum_mm: float
    tip_radius_mm: float

    def from_inner_corner_mm(self, across_mm, up_mm):
        """A point seen from the corner of the tooth without its outer `tip_radius_mm`: across, up, out of its flank, up along it."""
        sine, cosine = math.sin(self.pressure_angle_rad), math.cos(self.pressure_angle_rad)
        floor_mm = self.tip_radius_mm - self.dedendum_mm
        corner_mm = (0.25 * math.pi * self.module_mm * cosine + floor_mm * sine - self.tip_radius_mm) / cosine
        x_mm, y_mm = abs(across_mm) - corner_mm, up_mm - floor_mm
        return x_mm, y_mm, x_mm * cosine - y_mm * sine, x_mm * sine + y_mm * cosine

    def is_beside_flank(self, across_mm, up_mm):
        """Whether the straight flank is what is nearest to a point outside."""
        _, _, out_mm, along_mm = self.from_inner_corner_mm(across_mm, up_mm)
        return out_mm > 0.0 and along_mm > 0.0

    def distance_mm(self, across_mm, up_mm):
        """Signed distance of a point from the tooth, negative inside: of the tooth without its outer `tip_radius_mm`, less that."""
        x_mm, y_mm, out_mm, along_mm = self.from_inner_corner_mm(across_mm, up_mm)
        if out_mm > 0.0 and along_mm > 0.0:
            inner_mm = out_mm
        elif y_mm < 0.0:
            inner_mm = math.hypot(max(x_mm, 0.0), y_mm)
        else:
            inner_mm = max(out_mm, -y_mm)
        return inner_mm - self.tip_radius_mm


@dataclass
class CutGear:
    """A gear that the rack cuts, with tip circle and rounded tips."""

    rack: Rack
    teeth: int
    tip_radius_mm: float
    tip_rounding_mm: float

    def __post_init__(self):
        self.reference_radius_mm = 0.5 * self.teeth * self.rack.module_mm
        # A disc of the rounding's radius that touches the tip circle from inside and the flank: its centre.
        self.rounding_at_mm = self.tip_radius_mm - self.tip_rounding_mm
        self.rounding_angle = self.angle_at(self.rounding_at_mm, self.tip_rounding_mm)
        self.rounding_roll = self.clearance_mm(self.rounding_at_mm, self.rounding_angle)[1]

    def seen_from_rack_mm(self, radius_mm, angle, roll):
        """Distance from the rack after the gear has turned by `roll` and the rack gone along without slipping."""
        turned = angle + roll
        return self.rack.distance_mm(-radius_mm * math.sin(turned) + self.reference_radius_mm * roll,
                                     radius_mm * math.cos(turned) - self.reference_radius_mm)

    def clearance_mm(self, radius_mm, angle):
        """Least distance from the rack, and the roll there: 0 on the outline, above 0 in what stands."""
        step = 2.0 * REACH_MODULES * self.rack.module_mm / self.reference_radius_mm / (PLACES - 1)
        rolls = [(i - PLACES // 2) * step for i in range(PLACES)]
        distances = [self.seen_from_rack_mm(radius_mm, angle, roll) for roll in rolls]
        # The rack's flank and its tip may both come near; between places the distance falls by no more than a step of the roll, 0.05 modules.
        lowest = min(distances)
        dips = [i for i in range(1, PLACES - 1) if distances[i] <= min(distances[i - 1], distances[i + 1])
                and distances[i] < lowest + 0.05 * self.rack.module_mm]
        return min(self.dip(radius_mm, angle, rolls[i] - step, rolls[i] + step) for i in dips)

    def dip(self, radius_mm, angle, low, high):
        """The least distance between two rolls, by golden section."""
        a, b = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
        at_a, at_b = (self.seen_from_rack_mm(radius_mm, angle, roll) for roll in (a, b))
        while high - low > 1e-7:
            if at_a < at_b:
                high, b, at_b = b, a, at_a
                a = high - GOLDEN * (high - low)
                at_a = self.seen_from_rack_mm(radius_mm, angle, a)
            else:
                low, a, at_a = a, b, at_b
                b = low + GOLDEN * (high - low)
                at_b = self.seen_from_rack_mm(radius_mm, angle, b)
        return min((at_a, a), (at_b, b))

    def angle_at(self, radius_mm, clearance_mm=0.0):
        """The angle from the middle of the space where a circle of the gear is so far from the rack."""
        low, high = 0.0, math.pi / self.teeth
        for _ in range(50):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.clearance_mm(radius_mm, middle)[0] < clearance_mm else (low, middle)
        return 0.5 * (low + high)

    def is_cut_by_tip(self, radius_mm):
        """Whether the outline at a radius is the work of the rack's tip, not of its straight flank."""
        _, roll = self.clearance_mm(radius_mm, angle := self.angle_at(radius_mm))
        turned = angle + roll
        across_mm = -radius_mm * math.sin(turned) + self.reference_radius_mm * roll
        return not self.rack.is_beside_flank(across_mm, radius_mm * math.cos(turned) - self.reference_radius_mm)

    def form_radius_mm(self):
        """Where the rack's tip leaves off and its flank goes on."""
        low, high = self.reference_radius_mm - self.rack.dedendum_mm, self.reference_radius_mm
        for _ in range(40):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.is_cut_by_tip(middle) else (low, middle)
        return 0.5 * (low + high)

    def off_mm(self, radius_mm, angle):
        """Signed distance of a point from the outline with rounded tips, above 0 where material lacks."""
        angle = abs(angle)
        away = [p - q for p, q in zip(_place(radius_mm, angle), _place(self.rounding_at_mm, self.rounding_angle))]
        # From the rounding's centre to where its arc touches the tip circle, and to where it touches the flank.
        to_tip = _place(1.0, self.rounding_angle)
        to_flank = _place(1.0, self.rack.pressure_angle_rad - 0.5 * math.pi - self.rounding_roll)
        is_on_land = _cross(away, to_tip) <= 0.0
        if is_on_land and radius_mm > self.rounding_at_mm:
            return self.tip_radius_mm - radius_mm
        if not is_on_land and _cross(to_flank, away) > 0.0:
            return self.tip_rounding_mm - math.hypot(*away)
        return self.clearance_mm(radius_mm, angle)[0]


def _place(radius_mm, angle):
    """The middle of the space is up, angles are anticlockwise."""
    return -radius_mm * math.sin(angle), radius_mm * math.cos(angle)


def _cross(a, b):
    return a[0] * b[1] - a[1] * b[0]
