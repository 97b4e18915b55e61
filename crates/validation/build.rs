//! Tells cargo that the program holds the validation cases and the meshes they read: a case that is added or changed means
//! building anew.

fn main() {
    for folder in ["validation", "meshes"] {
        println!("cargo::rerun-if-changed=../../{folder}");
    }
}
