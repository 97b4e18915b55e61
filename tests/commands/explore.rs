//! `gearwear explore` from the outside, over bare connections.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::program::{exchanged, gearwear, json as json_file, preset};

/// Requests of others than the page.
const HOSTILE: usize = 1000;
/// Connections that are opened and say nothing.
const SILENT: usize = 200;

/// The program on a page, killed with this.
struct Server {
    child: Child,
    port: u16,
    word: String,
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Server {
    /// The program on `scene` in `folder`.
    fn on(scene: &str, folder: &Path) -> Self {
        fs::write(folder.join("scene.toml"), scene).unwrap();
        let mut command = gearwear();
        command.current_dir(folder).args(["explore", "scene.toml", "--no-browser"]);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut address = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut address).unwrap();
        let rest = address.trim().strip_prefix("http://127.0.0.1:").expect(&address);
        let (port, word) = rest.trim_end_matches('/').split_once('/').unwrap();
        Self { port: port.parse().unwrap(), word: word.to_owned(), child }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(60))).unwrap();
        stream
    }

    /// Status and body of the answer to these bytes; 0 where the connection was closed without one.
    fn told(&self, request: &[u8]) -> (u16, String) {
        let mut stream = self.connect();
        // A server that has refused may have closed already.
        let _ = stream.write_all(request);
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let status = text.strip_prefix("HTTP/1.1 ").and_then(|rest| rest.get(..3)?.parse().ok()).unwrap_or(0);
        (status, text.split_once("\r\n\r\n").map_or_else(String::new, |(_, body)| body.to_owned()))
    }

    /// Request of the page itself.
    fn request(&self, method: &str, name: &str, body: &str) -> String {
        let Self { port, word, .. } = self;
        format!(
            "{method} /{word}/{name} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nOrigin: http://127.0.0.1:{port}\r\nContent-Type: application/json\r\n\
             Content-Length: {}\r\nConnection: close\r\n\r\n{body}",
            body.len()
        )
    }

    fn post(&self, name: &str, question: &Value) -> (u16, Value) {
        let (status, body) = self.told(self.request("POST", name, &question.to_string()).as_bytes());
        (status, serde_json::from_str(&body).unwrap_or(Value::Null))
    }

    fn is_running(&mut self) -> bool {
        self.child.try_wait().unwrap().is_none()
    }

    /// Exit status, if the program ends soon.
    fn ends(&mut self) -> Option<i32> {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(30) {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status.code();
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        None
    }
}

/// A scene whose answers take milliseconds, and need no finite elements.
fn quick() -> String {
    exchanged("thesis-spur", &[("surface = \"winkler\"", "surface = \"hertz-mean\"")])
}

fn column(table: &Path, name: &str) -> Vec<f64> {
    let mut rows = csv::Reader::from_path(table).unwrap();
    let at = rows.headers().unwrap().iter().position(|column| column == name).unwrap();
    rows.records().map(|row| row.unwrap()[at].parse().unwrap()).collect()
}

/// Figures and curves of an answer are those of a run of the scene that the page saves, to the last digit.
fn equals_run(server: &Server, folder: &Path, setting: &Value, model: &str) {
    let question = json!({ "setting": setting, "model": model });
    let (status, answer) = server.post("answer", &question);
    assert_eq!(status, 200, "{answer}");
    let (status, saved) = server.post("scene", &question);
    assert_eq!(status, 200, "{saved}");
    let folder = folder.join(model);
    fs::create_dir(&folder).unwrap();
    for file in saved["files"].as_array().unwrap() {
        fs::write(folder.join(file["name"].as_str().unwrap()), file["text"].as_str().unwrap()).unwrap();
    }
    let scene = folder.join("scene.toml");
    let run = folder.join("run");
    let args = ["run", scene.to_str().unwrap(), "--out", run.to_str().unwrap(), "--quiet", "--no-report"];
    let output = gearwear().args(args).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let summary = json_file(&run.join("summary.json"));
    for figure in answer["figures"].as_array().unwrap() {
        let path = format!("/{}", figure["name"].as_str().unwrap().replace('.', "/"));
        assert_eq!(Some(&figure["value"]), summary.pointer(&path), "{model}: {path}");
    }
    for (table, curves) in [
        ("pinion.csv", &answer["flanks"]["pinion"]),
        ("wheel.csv", &answer["flanks"]["wheel"]),
        ("mesh_cycle.csv", &answer["mesh_cycle"]),
    ] {
        for (name, values) in curves.as_object().unwrap().iter().filter(|(name, _)| *name != "zones_mm") {
            let values: Vec<f64> = values.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
            assert_eq!(values, column(&run.join(table), name), "{model}: {name} of {table}");
        }
    }
}

#[test]
fn answers_are_those_of_run_to_the_last_digit() {
    let folder = tempfile::tempdir().unwrap();
    let server = Server::on(&preset("fzg-c"), folder.path());
    let setting = json!({
        "pair.pinion.tip_relief.amount_um": 20.0,
        "pair.pinion.profile_shift": 0.2017,
        "operation.pinion_torque_Nm": 252.0,
        "wear.coefficient_m2_per_N": 2e-17,
    });
    equals_run(&server, folder.path(), &setting, "fast");
    // The band comes from a comparison, which a saved scene leaves out.
    let elements = json!({ "setting": setting, "model": "finite-elements" });
    let (status, answer) = server.post("answer", &elements);
    assert_eq!(status, 200, "{answer}");
    let wear = &answer["figures"][0];
    assert!(wear["difference"].as_f64().is_some_and(|difference| difference.abs() < 0.05), "{wear}");
    equals_run(&server, folder.path(), &setting, "finite-elements");
    // A newer question takes the place of an older one.
    std::thread::scope(|scope| {
        let older = scope.spawn(|| server.post("answer", &elements).0);
        std::thread::sleep(Duration::from_millis(50));
        let newer = json!({ "setting": {}, "model": "finite-elements" });
        assert_eq!(server.post("answer", &newer).0, 200);
        assert_eq!(older.join().unwrap(), 204);
    });
    // The scene itself has its own model and no file.
    let (_, saved) = server.post("scene", &json!({ "setting": setting, "model": "own" }));
    let [scene] = &saved["files"].as_array().unwrap()[..] else { panic!("{saved}") };
    let text = scene["text"].as_str().unwrap();
    assert!(text.contains("profile_shift = 0.2017") && text.contains("positions = 400"), "{text}");
}

#[test]
fn a_wrong_setting_is_told_as_the_scene_s_checks_tell_it() {
    let folder = tempfile::tempdir().unwrap();
    let scene = "[pair]\npreset = \"fzg-a\"\n[operation]\npinion_torque_Nm = 302.0\npinion_revolutions = 1e5\n[contact]\nsurface = \"hertz-mean\"\n\
                 [stiffness]\nmodel = \"weber-banaschek\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n";
    let server = Server::on(scene, folder.path());
    let told = |setting: Value| {
        let (status, said) = server.post("answer", &json!({ "setting": setting }));
        assert_eq!(status, 422);
        said["message"].as_str().unwrap().to_owned()
    };
    let unknown = told(json!({ "pair.pinion.teeth": 12 }));
    assert!(unknown.contains("unknown slider pair.pinion.teeth"), "{unknown}");
    let outside = told(json!({ "operation.pinion_torque_Nm": 1e9 }));
    assert!(outside.contains("operation.pinion_torque_Nm: found 1000000000; allowed: "), "{outside}");
    // Within the range of the slider, and still no tooth.
    let pointed = told(json!({ "pair.pinion.profile_shift": 1.1532 }));
    assert!(
        pointed.contains("the pinion tooth is pointed") && pointed.contains("; allowed: a tip diameter below"),
        "{pointed}"
    );
}

/// A step of a small random generator (Numerical Recipes).
fn next(seed: &mut u64) -> usize {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 33) as usize
}

/// A request that the page never sends.
fn hostile(server: &Server, seed: &mut u64) -> Vec<u8> {
    let good = server.request("POST", "answer", "{\"setting\":{},\"model\":\"fast\"}");
    let exchanged = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        good.replace(from, to).into_bytes()
    };
    let host = format!("Host: 127.0.0.1:{}", server.port);
    let origin = format!("Origin: http://127.0.0.1:{}", server.port);
    let body = |body: &str| server.request("POST", "answer", body).into_bytes();
    match next(seed) % 18 {
        0 => exchanged(&origin, "Origin: http://gear.example"),
        1 => exchanged(&origin, "Origin: null"),
        2 => exchanged(&host, "Host: gear.example"),
        3 => exchanged(&format!("{host}\r\n"), ""),
        4 => exchanged(&format!("{origin}\r\n"), ""),
        5 => exchanged(&server.word, &format!("{:032x}", next(seed))),
        6 => exchanged(&format!("/{}/answer", server.word), "/../../etc/passwd"),
        7 => exchanged("application/json", "text/plain"),
        8 => body(&format!("{{\"setting\":{{\"operation.pinion_torque_Nm\":{}}}}}", next(seed) as f64 * 1e3)),
        9 => body("{\"setting\":{\"wear.coefficient_m2_per_N\":1e999}}"),
        10 => body(&format!("{{\"setting\":{{\"{}\":1}}}}", "x".repeat(next(seed) % 9000))),
        11 => body(&"[".repeat(next(seed) % 16_000)),
        12 => body(&"9".repeat(200_000)),
        13 => exchanged("Content-Length: ", "Content-Length: 999999999"),
        14 => format!("GET / HTTP/1.1\r\nHost: x\r\nX: {}\r\n\r\n", "y".repeat(100_000)).into_bytes(),
        15 => (0..next(seed) % 3000).map(|_| next(seed) as u8).collect(),
        16 => {
            let method = ["PUT", "DELETE", "OPTIONS", "TRACE", "GET"][next(seed) % 5];
            server.request(method, "answer", "").into_bytes()
        }
        _ => good.as_bytes()[..next(seed) % good.len()].to_vec(),
    }
}

#[test]
fn hostile_requests_are_refused_and_leave_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut server = Server::on(&quick(), folder.path());
    let silent: Vec<TcpStream> = (0..SILENT).map(|_| server.connect()).collect();
    let mut seed = 44;
    for number in 0..HOSTILE {
        let request = hostile(&server, &mut seed);
        let mut stream = server.connect();
        let _ = stream.write_all(&request);
        // Half of what is said is never read, as by somebody who leaves.
        if number % 2 == 0 {
            let _ = stream.shutdown(Shutdown::Write);
            let mut told = Vec::new();
            let _ = stream.read_to_end(&mut told);
            let told = String::from_utf8_lossy(&told);
            assert!(!told.starts_with("HTTP/1.1 2"), "{number}: {}\n{told}", String::from_utf8_lossy(&request));
        }
    }
    assert!(server.is_running());
    let (status, answer) = server.post("answer", &json!({ "setting": {}, "model": "fast" }));
    assert_eq!(status, 200, "{answer}");
    drop(silent);
    let left: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().file_name()).collect();
    assert_eq!(left, ["scene.toml"]);
}

#[test]
fn the_program_ends_with_its_window() {
    let folder = tempfile::tempdir().unwrap();
    let mut server = Server::on(&quick(), folder.path());
    let (status, page) = server.told(server.request("GET", "", "").as_bytes());
    assert!(status == 200 && page.contains("<title>"), "{page}");
    let mut window = server.connect();
    window.write_all(server.request("GET", "window", "").as_bytes()).unwrap();
    let mut head = [0; 15];
    window.read_exact(&mut head).unwrap();
    assert_eq!(&head, b"HTTP/1.1 200 OK");
    assert!(server.is_running());
    drop(window);
    assert_eq!(server.ends(), Some(0));
}

#[test]
fn a_port_that_is_taken_is_said() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), quick()).unwrap();
    let taken = std::net::TcpListener::bind(("127.0.0.1", 0)).unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let args = ["explore", "scene.toml", "--no-browser", "--port", &port];
    let output = gearwear().current_dir(folder.path()).args(args).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && said.contains("--port: found"), "{said}");
}
