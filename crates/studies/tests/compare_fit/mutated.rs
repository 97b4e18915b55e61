//! Measured files with bytes and lines changed at random: each is read or refused, with a message that says what is allowed, and none stops the program.

use gearwear::measured_flank::file;
use gearwear::measured_flank::profile::MeasuredProfile;
use gearwear::measured_flank::teeth::TraceChoice;
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_files::text::decode;

use super::laboratory::Noise;

const EACH: u64 = 3000;

/// A file of each format.
fn files() -> [String; 4] {
    let rows = |between: &str, comma: bool| -> String {
        let row = |i: u32| format!("{:.2}{between}{:.3}\n", 34.3 + 0.2 * f64::from(i), -0.1 * f64::from(i));
        let rows: String = (0..30).map(row).collect();
        if comma { rows.replace('.', ",") } else { rows }
    };
    let values: String = (0..40).map(|i| format!(" {:.3}", -0.1 * f64::from(i))).collect();
    [
        format!("# gear = pinion\n# hours = 3\n# uncertainty_um = 0.2\nradius_mm,height_um\n{}", rows(",", false)),
        format!("\u{feff}\"Radius [mm]\";\"Höhe [µm]\"\r\n{}", rows(";", true)),
        format!(
            "# arc_from = tip\nZahn-Nr.\tFlanke\tDurchmesser\tAbweichung\n\t\t[mm]\t[µm]\n{}",
            "3\tlinks\t70,1\t0,5\n3\tlinks\t71\t-2\n4\tlinks\t70,1\t1\n4\tlinks\t70,5\t1\n4\tlinks\t71\t1\n"
        ),
        format!(
            "HEADER KS.MK.FILE\nUNDEFINED -2147483.648\n 21 :Modul: 4.5\n 22 :z: 16\n 24 :a: 20.0\n 26 :b: 14\n \
             41 :da: 68.4 68.4\n 44 :de: 82.0 82.0\nFlankenlinie:\nZahn-Nr.: 1 links / 40  Werte  x= 8.7\n{values}\nProfil:\n\
             Zahn-Nr.: 1 links / 40  Werte  z= 7.0\n{values}\nZahn-Nr.: 9 links / 40  Werte  z= 7.0\n{values}\n"
        ),
    ]
}

fn changed(text: &str, noise: &mut Noise) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    let mut below = |count: usize| ((noise.uniform() * count as f64) as usize).min(count.saturating_sub(1));
    for _ in 0..=below(4) {
        let at = below(bytes.len());
        match below(6) {
            0 => bytes[at] = below(256) as u8,
            1 => bytes.truncate(at.max(1)),
            2 => {
                bytes.remove(at);
            }
            3 => bytes.insert(at, b"0,.;-\t\n\"#=:/[]eE"[below(16)]),
            kind => {
                let mut lines: Vec<Vec<u8>> = bytes.split(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
                let (from, to) = (below(lines.len()), below(lines.len()));
                if kind == 4 {
                    lines.swap(from, to);
                } else {
                    lines.insert(to, lines[from].clone());
                }
                bytes = lines.join(&b'\n');
            }
        }
        if bytes.is_empty() {
            break;
        }
    }
    bytes
}

#[test]
fn files_changed_at_random_are_read_or_refused() {
    let scene = gearwear::scene::Resolved::from_toml(&super::scene(1e-17, 1.0)).unwrap().scene;
    let pair = GearPair::new(&scene.pair).unwrap();
    let mut noise = Noise::new(11);
    for text in files() {
        let whole = file::parse(&text, &TraceChoice::default()).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert!(whole.rows.len() >= 2);
        let mut refused = 0;
        for _ in 0..EACH {
            let bytes = changed(&text, &mut noise);
            let read = file::parse(&decode(&bytes), &TraceChoice::default())
                .and_then(|file| MeasuredProfile::on_flank(&file, &pair, Gear::Pinion));
            if let Err(error) = read {
                refused += 1;
                let message = error.to_string();
                assert!(message.contains("allowed: "), "{message}");
            }
        }
        println!("{refused} of {EACH} refused");
        assert!(refused > EACH / 20 && refused < EACH);
    }
}
