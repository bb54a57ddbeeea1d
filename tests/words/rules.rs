//! The private words, what the field says instead, and the idioms in which they are no private words.

/// Where a rule holds.
#[derive(Clone, Copy, PartialEq)]
pub enum Place {
    Everywhere,
    /// The code of Rust files: neither comments nor strings.
    Code,
    /// Comments in `src`, but for names in quotes.
    CommentsOfSrc,
    /// Outside the kernels, in which a lane is a SIMD lane.
    OutsideKernels,
}

/// Words or phrases, `|` between them, and what the field says instead.
pub struct Rule {
    pub forms: &'static str,
    pub term: &'static str,
    /// Phrases in which the word stays, for it means something else there.
    pub allowed: &'static str,
    /// Phrases in which it goes all the same.
    pub wrong: &'static str,
    pub place: Place,
}

impl Rule {
    const fn new(forms: &'static str, term: &'static str) -> Self {
        Self { forms, term, allowed: "", wrong: "", place: Place::Everywhere }
    }

    const fn but(mut self, allowed: &'static str) -> Self {
        self.allowed = allowed;
        self
    }

    const fn not_but(mut self, wrong: &'static str) -> Self {
        self.wrong = wrong;
        self
    }

    const fn only(mut self, place: Place) -> Self {
        self.place = place;
        self
    }
}

#[rustfmt::skip]
pub const RULES: &[Rule] = &[
    Rule::new("leg|legs", "bounce, path segment; depth, max_depth")
        .but("crate leg|new leg|the leg ends in the very plane"),
    Rule::new("way|ways", "path, direction, offset")
        .but("same way|wrong way|other way round|wrong way round|right way round|other way about|half way|\
              by the way|by way of|this way|that way|either way|no way|a way to|ways to|one way to|\
              another way to|only way|all the way|out of the way|on the way|under way|best way|better way|\
              usual way|any way|a way of|ways of|which way|quickest way|simplest way|obvious way|\
              general way|in its own way|different ways|in the way|other way|in another way|way as another|\
              one way as|in each way|in one way|in any other way|in every way|way to say|way round|way up|\
              in their own way|both ways|in two ways|in three ways|in many ways|in other ways|some way to|\
              every way to|way for")
        .not_but("way of light|ways of light|a way of the light|on its way|half way direction|\
              half way directions|half way vector"),
    Rule::new("share|shares", "throughput (of a path), weight (of a sample), fraction, albedo")
        .but("share a|share an|share one|share the|share this|share no|share it|share them|share its|\
              share their|share all|share both|share code|share nothing|share and share alike|shares a|\
              shares an|shares one|shares the|shares this|shares no|shares it|shares its|shares all|\
              shares nothing|to share|not share|would share|columns share|renderer share|shapes share|\
              share files|shares dimension|may share|can share|must share|they share")
        .not_but("a share|the share|its share|this share|what share|whose share|each share|every share|\
              share of|shares of|same share|largest share|light share|spot share"),
    Rule::new("density|densities", "pdf")
        .but("probability density|probability densities"),
    Rule::new("chance|chances", "probability; BSDF sampling; at random"),
    Rule::new("how likely|as likely as|as likely anywhere", "pdf, probability"),
    Rule::new("by lot", "at random"),
    Rule::new("all alike|dense as|as dense|were dense", "uniform, cosine-weighted, pdf"),
    Rule::new("aim at lights|aim at a light|aim at the light|aim at the lights|aims at lights|\
              aims at a light|aims at the light|aimed at lights|aimed at a light|aimed at the light|\
              aimed at the lights|aiming at lights|aiming at a light|aiming at the light|\
              aiming at the lights|not aimed at|light aimed|aimed light|nobody aimed|aimed at from|\
              aim at the environment|aimed at the environment|aim at the sky|aim at each light|\
              aimed at each light|aimed at it|aimed or|or aimed|was aimed at|are aimed at by|been aimed at",
              "sample a light (next-event estimation), light sampling"),
    Rule::new("weigh|weighs|weighed|weighing", "weight (verb), weighted; MIS"),
    Rule::new("matter", "material")
        .but("no matter|not matter|a matter of|the matter of|subject matter|matter of fact|matter more|\
              matter most|matter to|matter in|matter for|matter here|matter as|would matter|may matter|\
              can matter|it matter|another matter|matter which|matter how|matter where"),
    Rule::new("kit|kits", "pinhole, the renderer"),
    Rule::new("ours", "pinhole's"),
    Rule::new("facet|facets", "microfacet; a mesh has faces, triangles"),
    Rule::new("tiny mirror|tiny mirrors", "microfacet"),
    Rule::new("glint|glints", "BSDF sample, microfacet sample"),
    Rule::new("polished", "specular"),
    Rule::new("squarely", "at normal incidence"),
    Rule::new("slant|slants|slanted|slanting|slantingly|aslant", "obliquely, at grazing incidence")
        .but("slanted edge"),
    Rule::new("flat angle|flat angles|flat incidence", "grazing incidence"),
    Rule::new("half ball|half balls|half sphere|half spheres", "hemisphere"),
    Rule::new("stranger|strangers", "independent"),
    Rule::new("no number", "NaN")
        .but("no number of"),
    Rule::new("verdict|verdicts", "intersection; result"),
    Rule::new("doubtful", "uncertain"),
    Rule::new("narrows|narrowed|narrowing", "keep the closest, t_max")
        .but("narrowed to f|narrowing conversion"),
    Rule::new("the reach|a reach|its reach|no reach|whose reach|their reach|this reach|each reach|any reach|\
              that reach|reach is|reach of", "t_max, extent")
        .but("within reach of|within the reach|out of reach of|out of reach is|within its reach"),
    Rule::new("reach", "t_max, extent")
        .only(Place::Code),
    Rule::new("lane|lanes", "component (of a column)")
        .but("simd lane|simd lanes|lanes of simd|lanes wide|four lanes|eight lanes|sixteen lanes")
        .only(Place::OutsideKernels),
    Rule::new("judge|judges|judged|judging|judgement", "oracle; check, compare"),
    Rule::new("slip|slips", "mistake")
        .but("slip between|slips between|slip through|slips through|slip past|slips past"),
    Rule::new("plant|plants|planted|planting", "mutation, mutate"),
    Rule::new("met|meets|meet", "hit, intersect")
        .but("meet at|meets at|meet in|meets in|edges meet|lines meet|sides meet|faces meet|triangles meet|\
              surfaces meet|planes meet|walls meet|spaces meet|rays meet again|meets its floor|\
              meets the floor|meet the floor")
        .not_but("is met at|are met at"),
    Rule::new("flat shape|flat shapes|flat piece|flat pieces|flat light|flat lights|flat surface|\
              flat surfaces|flat lamp|flat lamps|flat colour|flat colours|looks flat|shade flat", "planar; unlit"),
    Rule::new("piece|pieces", "part")
        .but("piece of paper|piece of glass|piece of code|pieces of code|piece by piece"),
    Rule::new("swings across|swings within|swing across|swing within", "s-polarised, p-polarised"),
    Rule::new("lamp|lamps", "light, area light, emitter (an entity may be called \"lamp\")")
        .only(Place::CommentsOfSrc),
];

/// Types of old, and what they are called now.
#[rustfmt::skip]
pub const TYPES: &[(&str, &str)] = &[
    ("PinholeLens", "PerspectiveProjection"),
    ("ImageShape", "resolution and aspect"),
    ("ViewRectangle", "OrthographicWindow"),
    ("Refusal", "SceneError"),
    ("Asked AskedSampling AskedCamera", "Overrides"),
    ("Told Met Laid Carried Lit LitRows", "a noun that says what it holds"),
    ("Leg AddLeg", "Depth, Bounce"),
    ("ByChance Aimed Weighed", "Bsdf, Light, Mis"),
    ("Verdict", "Intersection"),
    ("Wide WideCrossing", "DoubleDouble"),
    ("Glint Facet", "MicrofacetSample"),
    ("Matter", "Material"),
    ("GlassWay MatteWay", "sample"),
    ("Flat", "Planar"),
    ("Lane LaneValues", "component"),
    ("Planted", "Mutation"),
    ("Slip", "Mistake"),
    ("SolidAngleDensity LightDensities", "pdf"),
];
