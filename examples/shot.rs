//! scratch
#[path = "../tests/render/studio.rs"]
mod studio;
use darzi::garment::scene::*;
use darzi::textile::fabric::Finish;
use darzi::textile::yarn::Fibre;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let what = args.get(1).map(String::as_str).unwrap_or("skirt");
    let paths: u32 = args.get(3).and_then(|s| s.parse().ok()).unwrap_or(16);
    let smooth = args.get(4).map(String::as_str) != Some("raw");
    let colour: [u8; 3] = match args.get(5).map(String::as_str) {
        Some("white") => [240, 238, 232],
        Some("black") => [28, 28, 32],
        Some("blue") => [40, 60, 120],
        _ => [178, 58, 48],
    };
    let (finish, fibre) = match args.get(6).map(String::as_str) {
        Some("satin") => (Finish::Satin, Fibre::Silk),
        Some("velvet") => (Finish::Velvet, Fibre::Silk),
        Some("wool") => (Finish::Wool, Fibre::Wool),
        Some("silk") => (Finish::Matte, Fibre::Silk),
        _ => (Finish::Matte, Fibre::Cotton),
    };
    let light = match args.get(7).map(String::as_str) {
        Some("daylight") => Light::Daylight,
        Some("overcast") => Light::Overcast,
        _ => Light::Studio,
    };
    let fabric = studio::fabric(finish, fibre, colour);
    let (compiled, draped) = match what {
        "ball" | "balltop" => studio::sheet_on_ball(fabric, studio::woven(colour)),
        _ => studio::skirt(fabric, studio::woven(colour)),
    };
    let (views, size) = match what {
        "sheet" => (vec![View::Front, View::Side, View::Back, View::ThreeQuarter], [1200, 1600]),
        "top" | "balltop" => (vec![View::Top], [900, 900]),
        "ball" => (vec![View::Front], [1000, 1000]),
        "close" => (vec![View::ThreeQuarter], [3000, 4000]),
        _ => (vec![View::ThreeQuarter], [900, 1200]),
    };
    let t = std::time::Instant::now();
    let image = darzi::render::render(
        &compiled,
        &draped,
        &Picture { views, size, light },
        &darzi::render::Options { paths, smooth, ..Default::default() },
        &mut darzi::progress::Quiet,
    );
    eprintln!("{what}: {:.2} s", t.elapsed().as_secs_f64());
    let image = match args.get(8) {
        Some(c) => {
            let n: Vec<u32> = c.split(',').map(|s| s.parse().unwrap()).collect();
            image::imageops::crop_imm(&image, n[0], n[1], n[2], n[3]).to_image()
        }
        None => image,
    };
    image.save(args.get(2).map(String::as_str).unwrap_or("/tmp/shot.png")).unwrap();
}
