//! Gears as bodies: geometry ([`gear`]), material ([`material`]), the mesher ([`gear_mesh`]) and finite elements of a pair ([`gear_fem`]), nominal root stress
//! ([`root_stress`]), and the closed forms that these and the physics above share ([`mod@reference`]).

#![allow(
    rustdoc::private_intra_doc_links,
    reason = "its documentation is read by those who work on it, private items with it"
)]

pub mod gear;
pub mod gear_fem;
pub mod gear_mesh;
pub mod material;
pub mod reference;
pub mod root_stress;
