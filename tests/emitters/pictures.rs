//! Whole pictures: a floor lit by a light with an area, against closed forms.
