//! Films, friction and losses of the mesh, and the numbers of standards about them, in closed form.
//!
//! | question | module |
//! |---|---|
//! | viscosity, density, pressure–viscosity coefficient of an oil at a temperature | [`oil`] |
//! | load, radius and speeds of two surfaces that roll and slide on each other under pressure | [`rolling_contact`] |
//! | thickness of the film in such a contact | [`film`] |
//! | the local film of ISO/TS 6336-22 with its flash temperature | [`local_film`] |
//! | where on the path which part of the load is, by the standards | [`load_sharing_factor`] |
//! | coefficient of friction | [`friction`] |
//! | Ohlendorf's loss factor | [`loss`] |
//! | scuffing: flash and integral temperature | [`scuffing`] |
//! | film and friction wherever the teeth of a pair touch | [`running_pair`] |
//!
//! Units are those of the standards, as every formula carries constants of its own: mm, N, MPa, m/s, mPa·s, µm, °C, kW. Names say them.
//! All of it looks at the mesh from outside; nothing here changes a load, and wear only where a law reads the film.

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
