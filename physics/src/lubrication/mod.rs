//! Films, friction and losses of the mesh in closed form, with the numbers of the standards.
//!
//! | question | module |
//! |---|---|
//! | viscosity, density, pressure–viscosity coefficient of an oil at a temperature | [`oil`] |
//! | load, radius and speeds of two surfaces that roll and slide on each other under pressure | [`rolling_contact`] |
//! | thickness of the film in such a contact | [`film`] |
//! | the local film of ISO/TS 6336-22 with its flash temperature | [`local_film`] |
//! | load sharing along the path, by the standards | [`load_sharing_factor`] |
//! | coefficient of friction | [`friction`] |
//! | Ohlendorf's loss factor | [`loss`] |
//! | scuffing: flash and integral temperature | [`scuffing`] |
//! | film and friction of every contact of a pair | [`running_pair`] |
//!
//! Units are those of the standards: mm, N, MPa, m/s, mPa·s, µm, °C, kW, as names tell. Nothing here changes a load, and wear only where a law
//! reads the film.

pub mod film;
pub mod friction;
pub mod load_sharing_factor;
pub mod local_film;
pub mod loss;
pub mod oil;
pub mod rolling_contact;
pub mod running_pair;
pub mod scuffing;
pub mod settings;
