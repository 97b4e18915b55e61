//! Parts and instances of an Abaqus file.
//!
//! Nodes and elements of a part have numbers of their own. An instance is a copy of a part, first shifted, then turned about an axis
//! from a to b by an angle φ in degrees:
//!
//! ```text
//! x' = a + R (x + t − a)        R: rotation by φ about (b − a)/|b − a|
//! *INSTANCE, NAME=, PART=
//! t_x, t_y, t_z
//! a_x, a_y, a_z, b_x, b_y, b_z, φ
//! ```
//!
//! What stands outside parts and instances belongs to the assembly. A file without instances has its parts in their place. Source:
//! *Abaqus Keywords Reference Guide*, `*INSTANCE`; *Abaqus Analysis User's Guide*, "Defining an assembly".

use nalgebra::{Point3, Rotation3, Translation3, Unit, Vector3};

use super::keywords::{Keyword, Name, split};
use crate::error::{FileFault, FileProblem};

/// What has numbers and names of its own: the assembly, or an instance.
#[derive(Debug)]
pub(super) struct Scope<'k, 'a> {
    /// Name of the instance; `None` for the assembly.
    pub instance: Option<&'k Name>,
    pub keywords: Vec<&'k Keyword<'a>>,
    pub placement: Placement,
}

/// Place of an instance: first shifted, then turned.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Placement {
    shift_mm: Option<Translation3<f64>>,
    /// Point of the axis, and rotation.
    turn: Option<(Point3<f64>, Rotation3<f64>)>,
}

impl Placement {
    pub(super) fn of(&self, point: [f64; 3]) -> [f64; 3] {
        let mut place = Point3::from(point);
        if let Some(shift) = self.shift_mm {
            place = shift * place;
        }
        if let Some((axis, rotation)) = self.turn {
            place = axis + rotation * (place - axis);
        }
        place.into()
    }

    fn read(keyword: &Keyword) -> Result<Self, FileFault> {
        let mut placement = Self::default();
        for &(at, text) in &keyword.data {
            let fields: Vec<&str> = split(text).into_iter().map(str::trim).collect();
            let numbers =
                fields.iter().map(|field| if field.is_empty() { Some(0.0) } else { super::read::real(field) });
            let numbers = numbers.collect::<Option<Vec<f64>>>();
            match numbers.as_deref() {
                Some(&[ax, ay, az, bx, by, bz, degrees]) => {
                    let axis = Vector3::new(bx - ax, by - ay, bz - az);
                    let Some(axis) = Unit::try_new(axis, 0.0) else {
                        return Err(
                            keyword.fault(at, FileProblem::unexpected(text, "two different points of the axis"))
                        );
                    };
                    let rotation = Rotation3::from_axis_angle(&axis, degrees.to_radians());
                    placement.turn = Some((Point3::new(ax, ay, az), rotation));
                }
                Some(&[x, ref rest @ ..]) if rest.len() < 3 => {
                    let [y, z] = [0, 1].map(|place| rest.get(place).copied().unwrap_or(0.0));
                    placement.shift_mm = Some(Translation3::new(x, y, z));
                }
                _ => {
                    let expected = "a shift (three numbers), or two points of an axis and an angle (seven)";
                    return Err(keyword.fault(at, FileProblem::unexpected(text, expected)));
                }
            }
        }
        Ok(placement)
    }
}

/// The assembly first, then the instances in the order of the file.
pub(super) fn scopes<'k, 'a>(keywords: &'k [Keyword<'a>]) -> Result<Vec<Scope<'k, 'a>>, FileFault> {
    /// Where a keyword belongs.
    #[derive(Clone, Copy)]
    enum Within {
        Assembly,
        Part(usize),
        Instance(usize),
    }
    let mut parts: Vec<Scope> = Vec::new();
    let mut scopes = vec![Scope { instance: None, keywords: Vec::new(), placement: Placement::default() }];
    let mut within = Within::Assembly;
    for keyword in keywords {
        match keyword.name.as_str() {
            "PART" => {
                let name = keyword.required("NAME")?;
                if parts.iter().any(|part| part.instance.is_some_and(|own| own.is(name))) {
                    return Err(
                        keyword.fault(keyword.at, FileProblem::unexpected(&name.text, "parts of different names"))
                    );
                }
                parts.push(Scope { instance: Some(name), keywords: Vec::new(), placement: Placement::default() });
                within = Within::Part(parts.len() - 1);
            }
            "INSTANCE" => {
                let (name, part) = (keyword.required("NAME")?, keyword.required("PART")?);
                let Some(part) = parts.iter().find(|own| own.instance.is_some_and(|own| own.is(part))) else {
                    let names = parts.iter().filter_map(|part| Some(part.instance?.text.as_str()));
                    let expected = format!("a part defined before ({})", names.collect::<Vec<_>>().join(", "));
                    return Err(keyword.fault(keyword.at, FileProblem::unexpected(&part.text, expected)));
                };
                if scopes.iter().any(|scope| scope.instance.is_some_and(|own| own.is(name))) {
                    let expected = "instances of different names";
                    return Err(keyword.fault(keyword.at, FileProblem::unexpected(&name.text, expected)));
                }
                let placement = Placement::read(keyword)?;
                scopes.push(Scope { instance: Some(name), keywords: part.keywords.clone(), placement });
                within = Within::Instance(scopes.len() - 1);
            }
            "END PART" | "ASSEMBLY" | "END INSTANCE" | "END ASSEMBLY" => within = Within::Assembly,
            _ => match within {
                Within::Assembly => scopes[0].keywords.push(keyword),
                Within::Part(part) => parts[part].keywords.push(keyword),
                Within::Instance(instance) => scopes[instance].keywords.push(keyword),
            },
        }
    }
    if scopes.len() == 1 {
        if let [part] = parts.as_mut_slice() {
            // Alone it is the instance of whatever name.
            part.instance = None;
        }
        scopes.append(&mut parts);
    }
    Ok(scopes)
}
