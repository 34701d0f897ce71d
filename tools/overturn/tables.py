"""Fields of a spectrum, quantities of its points. Written by tests/python/stub_test.py --write."""

FIELDS = ("region", "angle", "velocity", "margin", "error", "peak", "fall_time", "friction_demand", "normal", "slide",
          "slide_peak", "impacts", "steps", "status")
# Units in sentences, role, and the quantity of which this is another spelling.
QUANTITIES = {
    "direction": ("degree", "direction", ""),
    "width": ("m", "block", ""),
    "half_width": ("m", "block", "width"),
    "height": ("m", "block", ""),
    "half_height": ("m", "block", "height"),
    "center_offset": ("m", "block", ""),
    "center_height": ("m", "block", ""),
    "slenderness_plus": ("rad", "block", ""),
    "slenderness_minus": ("rad", "block", ""),
    "size_plus": ("m", "block", ""),
    "size_minus": ("m", "block", ""),
    "radius_of_gyration": ("m", "block", ""),
    "incline": ("rad", "block", ""),
    "slenderness": ("rad", "block", ""),
    "aspect_ratio": ("", "block", "slenderness"),
    "size": ("m", "block", ""),
    "frequency_parameter": ("1/s", "block", "size"),
    "friction": ("", "block", ""),
    "restitution": ("", "loss", ""),
    "restitution_of_maximum": ("", "loss", "restitution"),
    "velocity_restitution": ("", "loss", "restitution"),
    "amplitude": ("", "strength", ""),
    "scale": ("", "strength", "amplitude"),
    "pga": ("g", "strength", "amplitude"),
    "frequency": ("", "rate", ""),
    "pulse_period": ("s", "rate", "frequency"),
    "pulse_frequency": ("Hz", "rate", "frequency"),
}


def _of_role(role):
    return tuple(name for name, (_, each, _) in QUANTITIES.items() if each == role)


STRENGTHS, RATES = _of_role("strength"), _of_role("rate")
SIZES = tuple(name for name, (_, _, same_as) in QUANTITIES.items() if "size" in (name, same_as))
